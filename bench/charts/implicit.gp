# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='implicit'; ..." implicit.gp, in the folder of implicit.csv
load style
@terminal
set output name.".".ending
methods = "'leapfrog' 'implicit' 'tr-bdf2' 'XPBD 1 sweep' 'leapfrog begun 1 um beside'"
array c[5] = ["#0072B2", "#D55E00", "#009E73", "#56B4E9", "#0072B2"]
array p[5] = [7, 9, 5, 11, 6]
scenes = "springs even lined skirt"
set multiplot layout 2,2 title "Implicit steps: error against processor time, one point a step length (numbers: their steps a second)" \
  font font.",13" margins 0.075,0.985,0.19,0.91 spacing 0.075,0.14
set logscale xy
unset mytics
unset key
set xlabel "processor seconds per simulated second" offset 0,0.4
n = 0
do for [scene in scenes] {
  n = n + 1
  set title system(sprintf("sed -n 's/^%s,\"\\([^\"]*\\)\".*/\\1/p' implicit.csv | head -1", scene)) offset 0,-0.6
  set ylabel (n % 2 == 1 ? "error / way [-]" : "") offset 1,0
  set format y "10^{%T}"
  if (scene eq "skirt") { set yrange [0.01:3]; set ytics 0.01,10,1 } else { set yrange [3e-8:2]; set ytics 1e-7,10,1 }
  set autoscale x
  # 10 and 1 %
  set arrow 1 from graph 0, first 0.1 to graph 1, first 0.1 nohead dt 3 lw 1 lc rgb "#555555"
  set arrow 2 from graph 0, first 0.01 to graph 1, first 0.01 nohead dt 2 lw 1 lc rgb "#555555"
  mine(m) = strcol(1) eq scene && strcol(3) eq word(methods, m) && $7 < 3
  plot for [m=1:5] "implicit.csv" using (mine(m) && $7 > 0 ? $6 : NaN):7 skip 1 with linespoints lw 1.6 ps 1 pt p[m] lc rgb c[m], \
    for [m=2:3] "" using (mine(m) ? $6 : NaN):7:(sprintf("%.0f", 1/$4)) skip 1 with labels offset 1.2,0.6 font font.",8" tc rgb c[m], \
    "" using (mine(1) && scene eq "skirt" ? $6 : NaN):(0.01) skip 1 with points pt 7 ps 1 lc rgb c[1]
}
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale; unset arrow
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set key at screen 0.53,0.06 center center horizontal maxrows 5 reverse Left width 2 samplen 2.5 font font.",11"
plot for [m=1:4] NaN with linespoints lw 1.6 ps 1 pt p[m] lc rgb c[m] title word(methods, m), \
  NaN with points pt p[5] ps 1 lc rgb c[5] title "leapfrog begun 1 µm beside", \
  NaN with lines dt 3 lw 1 lc rgb "#555555" title "10 %", \
  NaN with lines dt 2 lw 1 lc rgb "#555555" title "1 %", \
  NaN with points pt 7 lc rgb c[1] title "skirt: leapfrog is the reference (at the bottom)"
unset multiplot
