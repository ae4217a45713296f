# SPDX-License-Identifier: GPL-3.0-or-later
# bench/charts/draw FOLDER fast_mode, of the fast_mode.csv there.
load style
@terminal
set output name.".".ending
unset grid
unset key
# Where a number lies among the columns, which stand at equal distances, four to a doubling.
place(number) = 4 * log(number / 0.04) / log(2)
row(cap) = cap == 0 ? 9 : cap < 1.2 ? 1 : cap < 1.8 ? 2 : cap < 3 ? 3 : cap < 7 ? 4 : cap < 20 ? 5 : cap < 50 ? 6 : cap < 500 ? 7 : 8
ends = "converged unfinished limit_cycle diverged"
array fill[4] = ["#009E73", "#F0E442", "#E69F00", "#B2182B"]
array caption[4] = ["at rest: residual < 2 % of a weight", "neither after 50 000 passes", "limit cycle", "diverged"]
named(s) = s eq "limit cycle" ? "limit_cycle" : s
set multiplot layout 2,2 title "Displacing by force: what comes to rest, step × cap on forces" font font.",13" \
  margins 0.08,0.985,0.17,0.9 spacing 0.085,0.11
set tics out nomirror
set xrange [-0.5:16.5]
set yrange [0.5:9.5]
set xtics nomirror ("0.04" 0, "0.08" 4, "0.16" 8, "0.32" 12, "0.64" 16)
set ytics nomirror ("1.05" 1, "1.5" 2, "2" 3, "5" 4, "10" 5, "30" 6, "100" 7, "1000" 8, "none" 9)
do for [stretched in "1 1.6"] {
  do for [cloth in "chain sheet"] {
    limit = cloth eq "chain" ? 0.25 : 1.0 / 12
    set title (cloth eq "chain" ? "Hanging chain" : "Hanging sheet"). \
      (stretched eq "1" ? ", start at rest lengths" : ", start stretched by 60 %") font font.",11" offset 0,-0.6
    set arrow 1 from place(limit), 0.5 to place(limit), 9.5 nohead front lw 2.5 lc rgb "#000000"
    if (cloth eq "chain") { set ylabel "cap [mean weights]" } else { unset ylabel }
    if (stretched eq "1.6") { set xlabel "α c e / L [-], e the largest strain in balance" } else { unset xlabel }
    plot for [s=1:4] "fast_mode.csv" using (strcol(1) eq cloth && strcol(2) eq stretched && \
      named(strcol(8)) eq word(ends, s) ? $3 : NaN):(row($5)):(0.47):(0.47) with boxxyerror fs solid noborder fc rgb fill[s]
  }
}
unset title; unset xlabel; unset ylabel; unset arrow; unset border; unset tics
set origin 0, 0
set size 1, 0.08
set margins 0, 0, 0, 0
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.045 center center horizontal maxrows 2 reverse Left samplen 1.5
plot for [s=1:4] NaN with boxes fs solid noborder fc rgb fill[s] title caption[s], \
  NaN with lines lw 2.5 lc rgb "#000000" title "predicted limit: 1/4 (chain), 1/12 (sheet)"
unset multiplot
