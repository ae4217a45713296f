# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='work-cpu'; ..." work.gp (or work-passes), in the folder of work*.csv
load style
@terminal
set output name.".".ending
by_cpu = name eq "work-cpu"
column_x = by_cpu ? 5 : 6
methods = "'explicit Euler' 'semi-implicit Euler' 'leapfrog' 'RK4' 'implicit' 'XPBD 1 sweep' 'XPBD 10 sweeps' \
  'XPBD 100 sweeps'"
order = "pendulum chain small-soft large-soft small-medium large-medium small-stiff large-stiff"
set multiplot layout 4,2 title (by_cpu ? \
  "Error against processor time: one point a step length, one thread" : \
  "Error against passes over all springs: force evaluations, and sweeps of XPBD (an implicit step: one pass\n\
and a factorisation that is not counted)") font font.",13" margins 0.075,0.985,0.145,0.945 spacing 0.075,0.055
set logscale xy
set format xy "10^{%T}"
set yrange [1e-10:4]
set xtics nomirror
set ytics nomirror 1e-10,100,1
unset mytics
set xlabel (by_cpu ? "processor seconds per simulated second" : "passes per simulated second") offset 0,0.5
set ylabel "error / way" offset 1,0
shown(scene, method) = strcol(1) eq scene && strcol(2) eq method
do for [scene in order] {
  if (int(system(sprintf("grep -c '^%s,' work_references.csv || true", scene))) == 0) { set multiplot next; continue }
  unset label; unset arrow; unset object; unset key
  field(n) = 0.0 + (system(sprintf("awk -F, '{ gsub(/\"[^\"]*\"/, \"\"); if ($1 == \"%s\") print $%d }' " . \
                                 "work_references.csv", scene, n)))
  check = scene eq "pendulum" ? 0 : field(8)  # its end is known from elsewhere
  limit = field(by_cpu ? 11 : 12)
  heading = system(sprintf("sed -n 's/^%s,\"\\([^\"]*\\)\".*/\\1/p' work_references.csv", scene))
  set title heading offset 0,-0.6
  if (by_cpu) { set xrange [(scene eq "pendulum" ? 1e-6 : scene eq "chain" ? 3e-5 : 4e-4):(scene eq "pendulum" ? 1e-2 : scene eq "chain" ? 10 : 1e2)] } \
  else { set xrange [10:(scene eq "pendulum" ? 1e5 : scene eq "chain" ? 1e6 : 3e6)] }
  set object 1 rectangle from graph 0, first 1e-10 to graph 1, first (check > 1e-10 ? check : 1e-10) \
    fc rgb "#e4e4e4" fs solid noborder behind
  set arrow 1 from first limit, graph 0 to first limit, graph 1 nohead dt 2 lw 1.5 lc rgb "#0072B2"
  set arrow 2 from graph 0, first 0.1 to graph 1, first 0.1 nohead dt 3 lw 1 lc rgb "#888888"
  set label 2 "10 %" at graph 0.985, first 0.1 right offset 0,0.5 font font.",9" tc rgb "#666666"
  set arrow 3 from graph 0, first 0.01 to graph 1, first 0.01 nohead dt 3 lw 1 lc rgb "#888888"
  set label 3 "1 %" at graph 0.985, first 0.01 right offset 0,0.5 font font.",9" tc rgb "#666666"
  plot for [i=1:8] "work.csv" using (shown(scene, word(methods, i)) && strcol(8) ne "diverged" ? column(column_x) : NaN) \
      :7 skip 1 with lines lw 1.6 lc rgb colour[i], \
    for [i=1:8] "work.csv" using (shown(scene, word(methods, i)) && strcol(8) eq "ok" ? column(column_x) : NaN) \
      :7 skip 1 with points pt closed[i] ps 0.8 lc rgb colour[i], \
    for [i=1:8] "work.csv" using (shown(scene, word(methods, i)) && strcol(8) eq "wrong" ? column(column_x) : NaN) \
      :7 skip 1 with points pt open[i] ps 0.9 lc rgb colour[i], \
    for [i=1:8] "work.csv" using (shown(scene, word(methods, i)) && strcol(8) eq "diverged" ? column(column_x) : NaN) \
      :(2.2) skip 1 with points pt 2 ps 0.9 lw 1.5 lc rgb colour[i]
}
# The key, below all.
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale; unset label; unset arrow; unset object
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set key at screen 0.53,0.055 center center horizontal maxrows 5 reverse Left width 1 samplen 2.5 spacing 1.15 font font.",11"
plot for [i=1:8] NaN with linespoints lw 1.6 pt closed[i] lc rgb colour[i] title word(methods, i), \
  NaN with points pt 6 lc rgb "#555555" title "open: wrong, error above 10 %; filled: below", \
  NaN with points pt 2 lc rgb "#555555" title "cross at the top: diverged", \
  NaN with lines dt 2 lw 1.5 lc rgb "#0072B2" title "leapfrog at its limit, dt = 2/ω_{max}", \
  NaN with lines dt 3 lw 1 lc rgb "#888888" title "errors of 10 % and 1 %", \
  NaN with lines lw 6 lc rgb "#e4e4e4" title "below the check of the reference"
unset multiplot
