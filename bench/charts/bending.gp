# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='bending'; ..." bending.gp, in the folder of bending.csv
load style
@terminal
set output name.".".ending
meshes = "'one diagonal' 'by row' 'union jack' 'equilateral' 'jittered' 'cut and jittered' 'blue noise' 'inserted line'"
array c[2] = ["#D55E00", "#0072B2"]
laws = "hinge plate"
set multiplot layout 2,4 title "Error against cost: a cantilever (w L^3 / B = 25) with 8, 16, 32 cells along it" \
  font font.",13" margins 0.06,0.985,0.16,0.88 spacing 0.03,0.12
set logscale xy
unset key
set yrange [2e-4:0.5]
set ytics ("0.1 %%" 1e-3, "1 %%" 1e-2, "10 %%" 0.1)
do for [m=1:8] {
  set title word(meshes, m) offset 0,-0.6
  if (m > 4) { set xlabel "processor time to rest [s]" offset 0,0.4 } else { unset xlabel }
  if (m == 1 || m == 5) { set ylabel "|error of H/W|" offset 1,0; set format y "%h" } else { unset ylabel }
  plot for [l=1:2] "bending.csv" using ((strcol(1) eq word(meshes, m) && strcol(2) eq word(laws, l)) ? $5 : NaN):(abs($7)) \
    skip 1 with linespoints lw 1.8 ps 1.2 pt (l == 1 ? 9 : 7) lc rgb c[l]
}
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.045 center center horizontal maxrows 1 reverse Left samplen 3 width 2 font font.",11"
plot NaN with linespoints lw 1.8 ps 1.2 pt 9 lc rgb c[1] title "hinges, clamp doubled (default)", \
  NaN with linespoints lw 1.8 ps 1.2 pt 7 lc rgb c[2] title "plate"
unset multiplot
