# gnuplot power.gp, where power.csv lies: how often an effect is detected and named, against its strength
set encoding utf8
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 1000,700 font 'DejaVu Sans,14'
set output 'power.png'
set logscale x
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror
set key outside top center maxrows 4
set xrange [1:*]; set yrange [0:1.02]
set xlabel 'strength s: norm of the whitened sensitivity after nuisances'
set ylabel 'share of single effects, 95 % intervals'
plot 'power.csv' using 's_mean':'detected':'detected_low95':'detected_high95' with yerrorlines lw 5 pt 7 ps 1.6 lc rgb 0x9AC6E5 title 'detected', \
     '' using 's_mean':'named':'named_low95':'named_high95' with yerrorlines lw 2 pt 7 lc rgb 0x009E73 title 'named rightly', \
     '' using 's_mean':'matched_filter' with lines lw 2 dt 2 lc rgb 0x555555 title 'a filter that knows the sensitivity, 1 % false alarms', \
     '' using 's_mean':'filter_bank' with lines lw 2 dt 3 lc rgb 0x999999 title 'one such filter for each of 38 effects'
