# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='metamorphic'; ending='svg'" metamorphic.gp, in the folder of metamorphic.csv
load style
@terminal
set output name.".".ending
methods = "'leapfrog' 'RK4' 'implicit' 'XPBD 100 sweeps' 'XPBD 10 sweeps' 'XPBD 1 sweep'"
array c[6] = ["#0072B2", "#CC79A7", "#D55E00", "#E69F00", "#009E73", "#56B4E9"]
array full[6] = [7, 9, 11, 13, 5, 9]
array empty[6] = [6, 8, 10, 12, 4, 8]
changes = "'rotated' 'permuted' 'other units' 'half the step' 'tenfold damping' 'other integrator' 'Newton'"
subjects = "'chain' 'cantilever' 'skirt of hinges' 'skirt of springs'"
index_of(list, what) = sum [i=1:words(list)] (word(list, i) eq what ? i : 0)
place(change, m) = -index_of(changes, change) - 0.12 * (m - 4)
least = 1e-10
shown(x) = abs(x) > least ? abs(x) : least
set multiplot layout 2,2 title "How far an equilibrium moves that should not, in its target (1: just met)" font font.",13" \
  margins 0.13,0.985,0.16,0.91 spacing 0.025,0.1
set logscale x
set format x "10^{%T}"
set xrange [0.5*least:1e4]
set xtics 1e-10,100,1e4
unset key
do for [n=1:4] {
  subject = word(subjects, n)
  set title subject.(n < 3 ? ": farthest particle / 0.1 % of the size" : ": |ΔE| / 1 % (filled), median distance / 3 mm (open)") \
    offset 0,-0.6 font font.",11"
  if (n % 2 == 1) { set ytics ("rotated" -1, "permuted" -2, "other units" -3, "half the step" -4, "tenfold damping" -5, \
      "other integrator" -6, "Newton's method" -7) } \
  else { set ytics ("" -1, "" -2, "" -3, "" -4, "" -5, "" -6, "" -7) }
  set yrange [(n < 3 ? -7.5 : -6.5):-0.5]
  set object 1 rectangle from first 1, graph 0 to graph 1, graph 1 fc rgb "#f6dcd0" fs solid noborder behind
  mine(m) = strcol(1) eq subject && strcol(3) eq word(methods, m)
  plot for [m=1:6] "metamorphic.csv" using (mine(m) ? shown(n < 3 ? $5/1e-3 : $6/0.01) : NaN):(place(strcol(2), m)) \
      skip 1 with points pt full[m] ps 0.9 lc rgb c[m], \
    for [m=1:6] "metamorphic.csv" using (mine(m) && n > 2 ? shown($7/3e-3) : NaN):(place(strcol(2), m)) \
      skip 1 with points pt empty[m] ps 1.1 lc rgb c[m]
}
unset title; unset border; unset tics; unset grid; unset object; unset logscale
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.09
set xrange [0:1]
set yrange [0:1]
set key at screen 0.53,0.05 center center horizontal maxrows 4 reverse Left width 2 samplen 1 font font.",11"
plot for [m=1:6] NaN with points pt full[m] ps 1.1 lc rgb c[m] title word(methods, m), \
  NaN with points pt 7 ps 1.1 lc rgb "#555555" title "filled: place (above), energy (below)", \
  NaN with points pt 6 ps 1.1 lc rgb "#555555" title "open: median distance (below)", \
  NaN with boxes fs solid noborder fc rgb "#f6dcd0" title "target missed", \
  NaN with lines lw 0 lc rgb "#ffffff" title "at the left border: less than 10^{-10}"
unset multiplot
