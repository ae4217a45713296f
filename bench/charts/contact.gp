# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='contact'; ..." contact.gp, in the folder of contact.csv
load style
@terminal
set output name.".".ending
states = "stable rough wrong diverged"
array fill[4] = ["#009E73", "#F0E442", "#E69F00", "#B2182B"]
bounded = "0.25 0.35 0.5 0.6 0.7 0.8 0.9 0.95 1.03 1.1 1.25 1.5"
# Where a ratio lies among the cells, which stand at equal distances.
ratio(i) = real(word(bounded, i))
place(r) = (sum [i=1:11] (r >= ratio(i) && r < ratio(i+1) ? i + log(r/ratio(i))/log(ratio(i+1)/ratio(i)) : 0))
panels = "leapfrog|0 leapfrog|0.3 semi-implicit|0 RK4|0 backward_Euler|0 XPBD_1_sweep|0"
part(s, n) = system(sprintf("echo '%s' | cut -d'|' -f%d | tr -d '\n'", s, n))
spaced(s) = system(sprintf("echo '%s' | tr '_' ' '", s))
rows = int(system("grep -v '^[#i]' contact.csv | cut -d, -f3 | sort -u | wc -l"))
half = 2.0 / (rows - 1)
set multiplot layout 2,3 title "What becomes of a sheet that falls on a ball (127 vertices, 0.3 s, friction 0.3): step × stiffness × integrator" \
  font font.",13" margins 0.065,0.99,0.18,0.9 spacing 0.025,0.13
unset key
set tics out
set yrange [1-half:5+half]
set ytics 1,1,5
n = 0
do for [panel in panels] {
  n = n + 1
  method = spaced(part(panel, 1)); jitter = part(panel, 2)
  unset arrow
  set title sprintf("%s, jitter %s", method, jitter) offset 0,-0.7 font font.",11"
  if (n % 3 == 1) { set ylabel "stiffness [N/m]" offset 0.3,0; set format y "10^{%.0f}" } \
  else { unset ylabel; set format y "" }
  if (n > 4) {
    set xrange [0.5:10.5]
    set xtics ("0.5" 1, "1" 2, "2" 3, "4" 4, "8" 5, "16" 6, "32" 7, "64" 8, "128" 9, "256" 10) font font.",9"
  } else {
    set xrange [0.5:12.5]
    set xtics (".25" 1, ".5" 3, ".7" 5, ".9" 7, "1.03" 9, "1.25" 11) \
      font font.",9"
    bound = method eq "RK4" ? sqrt(2) : 1
    set arrow 1 from place(bound), 1-half to place(bound), 5+half nohead front lw 2.5 lc rgb "#000000"
  }
  if (n > 3) { set xlabel "dt / (2/ω_{max}) at the start" offset 0,0.4 } else { unset xlabel }
  plot for [s=1:4] "contact.csv" using (strcol(1) eq method && strcol(2) eq jitter && strcol(12) eq word(states, s) ? $4 \
      : NaN):(log10($3)):(0.47):(0.94*half) skip 1 with boxxyerror fs solid noborder fc rgb fill[s]
}
# The legend, below all.
unset title; unset xlabel; unset ylabel; unset arrow; unset border; unset tics; unset grid
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.06
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.035 center center horizontal maxrows 2 reverse Left width -1 samplen 1.5 font font.",11"
plot NaN with boxes fs solid noborder fc rgb fill[1] title "energy never rises", \
  NaN with boxes fs solid noborder fc rgb fill[2] title "gains ≤ 1 % of m g R", \
  NaN with boxes fs solid noborder fc rgb fill[3] title "wrong: gains more, or sinks in", \
  NaN with boxes fs solid noborder fc rgb fill[4] title "diverged", \
  NaN with lines lw 2.5 lc rgb "#000000" title "limit without contact", \
  NaN with boxes lc rgb "#bbbbbb" fs empty border title "not run: under 4 steps"
unset multiplot
