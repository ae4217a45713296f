# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='stability'; ..." stability.gp, in the folder of stability.csv
load style
@terminal
set output name.".".ending
states = "stable rough wrong diverged"
array fill[4] = ["#009E73", "#F0E442", "#E69F00", "#B2182B"]
array ratio[17] = [0.25, 0.35, 0.5, 0.71, 0.85, 0.93, 0.98, 1.03, 1.1, 1.2, 1.3, 1.38, 1.45, 1.6, 2, 2.8, 4]
# Where a ratio lies among the cells, which stand at equal distances.
place(r) = (p = 1, sum [i=1:16] (r >= ratio[i] && r < ratio[i+1] ? i + log(r/ratio[i])/log(ratio[i+1]/ratio[i]) : 0))
rows = int(system("grep -v '^[#i]' stability.csv | cut -d, -f4 | sort -u | wc -l"))
half = 2.0 / (rows - 1)
safe(law, jitter) = system(sprintf("awk -F, '$1 == \"leapfrog\" && $2 == \"%s\" && $3 == %s { print $8; exit }' stability.csv", \
                                   law, jitter)) + 0.0
panels = "leapfrog|paper|0 leapfrog|uniform|0 leapfrog|inverse|0 leapfrog|van_gelder|0 \
leapfrog|paper|0.3 leapfrog|uniform|0.3 leapfrog|inverse|0.3 leapfrog|van_gelder|0.3 \
RK4|paper|0 RK4|paper|0.3 implicit|paper|0 implicit|paper|0.3"
part(s, n) = system(sprintf("echo '%s' | cut -d'|' -f%d | tr -d '\n'", s, n))
spaced(s) = system(sprintf("echo '%s' | sed 's/_/ /; s/van gelder/Van Gelder/'", s))
set multiplot layout 3,4 title "What becomes of a swinging sheet (95 vertices, 0.2 s): step × stiffness × law × jitter of the mesh" \
  font font.",13" margins 0.06,0.99,0.125,0.93 spacing 0.02,0.085
unset key
set tics out
set yrange [1-half:5+half]
set ytics 1,1,5
n = 0
do for [panel in panels] {
  n = n + 1
  method = spaced(part(panel, 1)); law = part(panel, 2); jitter = part(panel, 3)
  unset arrow
  set title sprintf("%s, %s, jitter %s", method, spaced(law), jitter) offset 0,-0.7 font font.",11"
  if (n % 4 == 1) { set ylabel "stiffness [N/m]" offset 0.3,0; set format y "10^{%.0f}" } \
  else { unset ylabel; set format y "" }
  if (method eq "implicit") {
    set xrange [0.5:15.5]
    set xtics ("2" 1, "4" 3, "8" 5, "16" 7, "32" 9, "64" 11, "128" 13, "256" 15) font font.",9"
  } else {
    set xrange [0.5:17.5]
    set xtics (".25" 1, ".5" 3, ".85" 5, ".98" 7, "1.1" 9, "1.3" 11, "1.45" 13, "2" 15, "4" 17) font font.",9"
    bound = method eq "RK4" ? sqrt(2) : 1
    set arrow 1 from place(bound), 1-half to place(bound), 5+half nohead front lw 2.5 lc rgb "#000000"
    if (method eq "leapfrog") {
      g = place(safe(law, jitter))
      set arrow 2 from g, 1-half to g, 5+half nohead front lw 2 dt 3 lc rgb "#000000"
    }
  }
  if (n > 8) { set xlabel "dt / (2/ω_{max})" offset 0,0.4 } else { unset xlabel }
  plot for [s=1:4] "stability.csv" using (strcol(1) eq method && strcol(2) eq law && strcol(3) eq jitter && \
      strcol(10) eq word(states, s) ? $5 : NaN):(log10($4)):(0.47):(0.94*half) skip 1 with boxxyerror \
      fs solid noborder fc rgb fill[s]
}
# The legend, below all.
unset title; unset xlabel; unset ylabel; unset arrow; unset border; unset tics; unset grid
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.06
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.035 center center horizontal maxrows 2 reverse Left width 1.5 samplen 1.5 font font.",11"
plot NaN with boxes fs solid noborder fc rgb fill[1] title "stable, error < 1 %", \
  NaN with boxes fs solid noborder fc rgb fill[2] title "1 to 10 %", \
  NaN with boxes fs solid noborder fc rgb fill[3] title "wrong, > 10 %", \
  NaN with boxes fs solid noborder fc rgb fill[4] title "diverged", \
  NaN with lines lw 2.5 lc rgb "#000000" title "predicted limit", \
  NaN with lines lw 2 dt 3 lc rgb "#000000" title "Gershgorin's safe step", \
  NaN with boxes lc rgb "#bbbbbb" fs empty border title "not run: under 2 steps"
unset multiplot
