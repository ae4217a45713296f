# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='equilibria'; ..." equilibria.gp, in the folder of equilibria.csv
load style
@terminal
set output name.".".ending
methods = "'Newton (statics)' 'implicit 1/15 s' 'implicit 1/60 s' 'implicit 1/240 s' 'XPBD 10 sweeps 1/240 s' 'XPBD 1 sweep 1/1200 s' 'RK4 1.2' 'leapfrog 0.9' 'semi-implicit Euler 0.9'"
scenes = "'catenary' 'cantilever 10' 'cantilever 25' 'cantilever 100'"
titles = "'Uneven chain, 32 springs' 'Cantilever, Γ = 10' 'Cantilever, Γ = 25' 'Cantilever, Γ = 100'"
row(m) = (sum [i=1:9] (m eq word(methods, i) ? i : 0))
set multiplot layout 1,4 title "Processor time until the cloth is at rest (residual force 1e-4 of a vertex's weight), and how far that is from theory" \
  font font.",13" margins 0.17,0.985,0.225,0.86 spacing 0.015,0.05
unset key
set ytics ("" 0)
set xtics 100
set mxtics 2
set logscale x
set format x "10^{%T}"
set xrange [1e-4:10]
set yrange [0.4:9.6] reverse
set xlabel "processor seconds" offset 0,0.4
do for [s=1:4] {
  scene = word(scenes, s)
  set title word(titles, s) offset 0,-0.5 font font.",11"
  if (s == 1) { set for [i=1:9] ytics add (word(methods, i) i) } else { set for [i=1:9] ytics add ("" i) }
  plot "equilibria.csv" using (strcol(1) eq scene ? 1e-4 : NaN):(row(strcol(2))):(($4)-1e-4):(0) skip 1 \
      with vectors nohead lw 5 lc rgb "#9ecae1", \
    "" using (strcol(1) eq scene && strcol(10) eq "at rest" ? $4 : NaN):(row(strcol(2))) skip 1 with points pt 7 ps 0.9 lc rgb "#0072B2", \
    "" using (strcol(1) eq scene && strcol(10) ne "at rest" ? $4 : NaN):(row(strcol(2))) skip 1 with points pt 6 ps 1 lw 1.6 lc rgb "#B2182B", \
    "" using (strcol(1) eq scene ? ($4 > 0.3 ? $4/1.6 : $4*1.5) : NaN):(row(strcol(2))-0.33): \
      ($9 < 1e-4 ? sprintf("%.0e", $9) : sprintf("%.2g %%", 100*$9)) skip 1 with labels font font.",8" tc rgb "#444444"
}
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set key at screen 0.53,0.05 center center horizontal maxrows 1 reverse Left width 2 samplen 1.5 font font.",11"
plot NaN with lines lw 5 lc rgb "#9ecae1" title "processor time", \
  NaN with points pt 7 ps 0.9 lc rgb "#0072B2" title "came to rest", \
  NaN with points pt 6 ps 1 lw 1.6 lc rgb "#B2182B" title "did not, in 60 simulated seconds", \
  NaN with points pt "1" lc rgb "#444444" title "numbers: error against theory (chain: / span; cantilever: of H/W)"
unset multiplot
