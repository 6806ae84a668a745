# gnuplot convergence.gp, where convergence.csv lies: error of images in full light against time
set encoding utf8
set datafile separator ','
set datafile columnheaders
set terminal pngcairo size 1280,800 font 'DejaVu Sans,14'
set output 'convergence.png'
set logscale xy
set grid lc rgb 0xE4E4E4 lt 1
set border 3; set tics nomirror
set key below
set xlabel 'processor time of the strip [s]'
set ylabel 'error [DN, rms]'
set title 'All light, 1, 4, 9 and 16 samples per pixel; dashed: the reference’s own standard error'
scenes = 'paper_water meniscus_water paper_milk_tea glass_water'
array colour[4] = [0x0072B2, 0x56B4E9, 0xD55E00, 0x009E73]
plot for [i = 1:4] 'convergence.csv' using (strcol(1) eq word(scenes, i) ? column('cpu_s') : NaN):'rmse_dn' \
       with linespoints lw 3 pt 7 lc rgb colour[i] title word(scenes, i) noenhanced, \
     for [i = 1:4] 'convergence.csv' using (strcol(1) eq word(scenes, i) ? column('cpu_s') : NaN):'reference_dn' \
       with lines lw 1 dt 2 lc rgb colour[i] notitle
