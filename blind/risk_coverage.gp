# gnuplot risk_coverage.gp, where risk_coverage.csv lies: the share of wrong ones among the most confident answers
set encoding utf8
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 1000,700 font 'DejaVu Sans,14'
set output 'risk_coverage.png'
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror
set key top left
set xrange [0:1]; set yrange [0:*]
set xlabel 'share of sets that are answered, the most confident first'
set ylabel 'share of wrong answers among them'
plot 'risk_coverage.csv' using 'coverage':'risk_low95':'risk_high95' with filledcurves fc rgb 0xCFE3F1 title '95 % interval', \
     '' using 'coverage':'risk' with lines lw 2 lc rgb 0x0072B2 title 'wrong'
