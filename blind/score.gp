# gnuplot score.gp, where the tables of blind_score lie: three pictures of how good the answers of a pack are
set encoding utf8
set datafile separator ','
set datafile columnheaders
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror

# How often what is put first with a probability is true.
set terminal pngcairo size 700,700 font 'DejaVu Sans,14'
set output 'reliability.png'
set key bottom right
set xrange [0:1]; set yrange [0:1.02]
set xlabel 'probability of what is put first'
set ylabel 'share that was true, 95 % intervals'
plot x with lines dt 2 lc rgb 0x555555 title 'perfectly calibrated', \
     'reliability.csv' using 'said':'true':'low95':'high95' with yerrorlines lw 2 pt 7 lc rgb 0x0072B2 title 'answers'

# The share of wrong ones among the most confident answers.
set terminal pngcairo size 1000,700 font 'DejaVu Sans,14'
set output 'risk_coverage.png'
set key top left
set xrange [0:1]; set yrange [0:*]
set xlabel 'share of sets that are answered, the most confident first'
set ylabel 'share of wrong answers among them'
plot 'risk_coverage.csv' using 'coverage':'risk_low95':'risk_high95' with filledcurves fc rgb 0xCFE3F1 title '95 % interval', \
     '' using 'coverage':'risk' with lines lw 2 lc rgb 0x0072B2 title 'wrong'

# How often an effect is detected and named, against its strength.
set output 'power.png'
set logscale x
set key outside top center maxrows 4
set xrange [1:*]; set yrange [0:1.02]
set xlabel 'strength s: norm of the whitened sensitivity after nuisances'
set ylabel 'share of single effects, 95 % intervals'
plot 'power.csv' using 's_mean':'detected':'detected_low95':'detected_high95' with yerrorlines lw 5 pt 7 ps 1.6 lc rgb 0x9AC6E5 title 'detected', \
     '' using 's_mean':'named':'named_low95':'named_high95' with yerrorlines lw 2 pt 7 lc rgb 0x009E73 title 'named rightly', \
     '' using 's_mean':'matched_filter' with lines lw 2 dt 2 lc rgb 0x555555 title 'a filter that knows the sensitivity, 1 % false alarms', \
     '' using 's_mean':'filter_bank' with lines lw 2 dt 3 lc rgb 0x999999 title 'one such filter for each of 38 effects'
