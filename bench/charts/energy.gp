# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='energy'; ..." energy.gp, in the folder of energy.csv
load style
@terminal
set output name.".".ending
set multiplot layout 1,2 title "A sheet of cotton swings for 1 s, and nothing damps it: what steps do to its energy" \
  font font.",13" margins 0.07,0.8,0.13,0.86 spacing 0.07
set xrange [0:1]
set xlabel "time [s]"
set key at screen 0.81,0.8 left top reverse Left samplen 2.5 spacing 1.4
names = "'leapfrog' 'tr-bdf2' 'tr-bdf2' 'tr-bdf2' 'implicit' 'implicit' 'implicit'"
rates = "0 240 120 60 240 120 60"
array c[7] = ["#0072B2", "#A6DBC8", "#4DB894", "#009E73", "#F5C99E", "#E8914A", "#D55E00"]
mine(m) = strcol(1) eq word(names, m) && (m == 1 || abs(1 / $2 - word(rates, m)) < 1)
label(m) = word(names, m).(m == 1 ? "" : ", 1/".word(rates, m)." s")
set title "kinetic energy / leapfrog's most" offset 0,-0.6
plot for [m=1:7] "energy.csv" using (mine(m) ? $3 : NaN):4 skip 1 with lines lw 1.8 lc rgb c[m] title label(m)
unset key
set title "all energy: change / leapfrog's most kinetic energy" offset 0,-0.6
plot for [m=1:7] "energy.csv" using (mine(m) ? $3 : NaN):5 skip 1 with lines lw 1.8 lc rgb c[m]
unset multiplot
