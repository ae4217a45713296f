# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='damping'; ..." damping.gp, in the folder of damping.csv
load style
@terminal
set output name.".".ending
set multiplot layout 1,2 title "Longest stable step against the damping of springs (95 vertices at rest, found by running)" \
  font font.",13" margins 0.065,0.74,0.13,0.86 spacing 0.06
set logscale x
set xrange [0.004:1.2]
set xtics ("0.005" 0.005, "0.01" 0.01, "0.02" 0.02, "0.05" 0.05, "0.1" 0.1, "0.2" 0.2, "0.5" 0.5, "1" 1) font font.",9"
set yrange [0:1.6]
set xlabel "damping, share of critical [-]"
set key at screen 0.75,0.8 left top reverse Left samplen 2.5 spacing 1.5
do for [jitter in "0 0.3"] {
  set title "jitter ".jitter offset 0,-0.6
  if (jitter eq "0") { set ylabel "longest dt / (2/ω_{max}) [-]" } else { unset ylabel; unset key }
  plot "damping.csv" using (strcol(2) eq jitter ? $1 : NaN):3 skip 1 with linespoints lw 1.6 pt 7 lc rgb "#0072B2" \
      title "leapfrog", \
    "" using (strcol(2) eq jitter ? $1 : NaN):4 skip 1 with points pt 4 ps 1.5 lc rgb "#D55E00" title "semi-implicit Euler", \
    "" using (strcol(2) eq jitter ? $1 : NaN):5 skip 1 with linespoints lw 1.6 pt 9 lc rgb "#CC79A7" title "RK4", \
    "" using (strcol(2) eq jitter ? $1 : NaN):7 skip 1 with lines lw 1.6 dt 2 lc rgb "#CC79A7" \
      title "RK4, what Furrow allows", \
    "" using (strcol(2) eq jitter ? $1 : NaN):6 skip 1 with linespoints lw 1.6 pt 5 lc rgb "#999999" title "explicit Euler", \
    "" using (strcol(2) eq jitter ? $1 : NaN):8 skip 1 with lines lw 1.6 dt 3 lc rgb "#000000" \
      title "leapfrog, naive (theory)"
}
unset multiplot
