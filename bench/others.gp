# gnuplot others.gp, where others.csv lies: error of dots under water against time, by renderer
set encoding utf8
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 1280,800 font 'DejaVu Sans,14'
set output 'others.png'
set logscale xy
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror
set key below
set xlabel 'processor time [U]'
renderers = '"Fathom" "POV-Ray photon map" "Cycles shadow caustics"'
array colour[3] = [0x0072B2, 0xE69F00, 0x009E73]
set multiplot layout 1,2 title 'Dots on the bottom under 30 mm of clear water'
do for [error in 'place_ir_px rmse'] {
  set ylabel error eq 'rmse' ? 'error of the pixels at best scale, relative' : 'error of the place [px, rms]'
  plot for [i = 1:3] 'others.csv' using (strcol(1) eq word(renderers, i) ? column('units') : NaN):error \
    with linespoints lw 3 pt 7 lc rgb colour[i] title word(renderers, i)
}
unset multiplot
