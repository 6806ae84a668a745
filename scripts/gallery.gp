# gnuplot -c scripts/gallery.gp OUT.png PREVIEW.png ...: the cups of several previews beside each other, one column each.
tile = 150; label = 26; side = 130
columns = ARGC - 1
set terminal pngcairo size side + columns * tile, label + 4 * tile font "sans,10"
set output ARG1
width = side + columns * tile * 1.0; height = label + 4 * tile * 1.0
array rows[4] = ["infrared image", "measured depth", "apparent depth", "difference, ±5 mm"]
array left[4] = [270, 910, 270, 910]   # of the cup, in each quarter of a preview
array bottom[4] = [650, 650, 170, 170]
set multiplot
unset key; unset border; unset tics
do for [column = 1:columns] {
  folder = value(sprintf("ARG%d", column + 1))
  folder = folder[1:strlen(folder) - strlen("/preview.png")]
  while (strstrt(folder, "/")) { folder = folder[strstrt(folder, "/") + 1:*] }
  do for [row = 1:4] {
    set lmargin at screen (side + (column - 1) * tile + 2) / width
    set rmargin at screen (side + column * tile - 2) / width
    set tmargin at screen 1 - (label + (row - 1) * tile + 2) / height
    set bmargin at screen 1 - (label + row * tile - 2) / height
    set xrange [left[row]:left[row] + 160]
    set yrange [bottom[row]:bottom[row] + 160]
    unset label
    if (row == 1) { set label 1 folder at graph 0.5, 1.09 center noenhanced }
    if (column == 1) { set label 2 rows[row] at graph -0.04, 0.5 right }
    plot value(sprintf("ARG%d", column + 1)) binary filetype=png with rgbimage
  }
}
