# gnuplot reliability.gp, where reliability.csv lies: how often what is put first with a probability is true
set encoding utf8
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 700,700 font 'DejaVu Sans,14'
set output 'reliability.png'
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror
set key bottom right
set xrange [0:1]; set yrange [0:1.02]
set xlabel 'probability of what is put first'
set ylabel 'share that was true, 95 % intervals'
plot x with lines dt 2 lc rgb 0x555555 title 'perfectly calibrated', \
     'reliability.csv' using 'said':'true':'low95':'high95' with yerrorlines lw 2 pt 7 lc rgb 0x0072B2 title 'answers'
