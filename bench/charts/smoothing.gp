# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='smoothing'; ..." smoothing.gp, in the folder of smoothing.csv
load style
@terminal
set output name.".".ending
curves = "laplace|uniform laplace|cotangent laplace|cotangent_of_rest taubin|uniform taubin|cotangent \
taubin|cotangent_of_rest strong_taubin|uniform"
titles = "'Laplace, uniform' 'Laplace, cotangent of noisy lengths' 'Laplace, cotangent of rest lengths' \
'Taubin .33|−.34, uniform' 'Taubin, cotangent of noisy lengths' 'Taubin, cotangent of rest lengths' 'Taubin .63|−.67, uniform'"
array c[7] = ["#0072B2", "#D55E00", "#009E73", "#0072B2", "#D55E00", "#009E73", "#000000"]
array p[7] = [4, 8, 12, 5, 9, 13, 7]
array d[7] = [2, 2, 2, 1, 1, 1, 1]
part(s, n) = system(sprintf("echo '%s' | cut -d'|' -f%d | tr -d '\n'", s, n))
array filter[7]
array weights[7]
do for [i=1:7] { filter[i] = part(word(curves, i), 1); weights[i] = part(word(curves, i), 2) }
of(body, i) = strcol(1) eq body && strcol(3) eq filter[i] && strcol(2) eq weights[i]
set multiplot layout 2,3 title "What smoothing takes away with the noise (±0.3 edges along the normals; points: 2, 4, 10, 20 … 1000 passes)" \
  font font.",13" margins 0.055,0.985,0.175,0.915 spacing 0.05,0.115
set logscale xy
unset mytics
unset mxtics
unset key
row = 0
do for [body in "ball mannequin"] {
  row = row + 1
  heading = body eq "ball" ? "uneven ball, 32,000 triangles" : "mannequin, 14,286 triangles"
  if (row == 2) { set xlabel "CPU time [ms]" offset 0,0.4 } else { unset xlabel }
  set xrange [(body eq "ball" ? 0.8 : 0.5):150]
  set yrange [24:300]
  set ytics (25, 30, 40, 50, 70, 100, 200, 300)
  set ylabel "distance from the clean surface / before [%]" offset 1.2,0
  set title heading.": noise left" offset 0,-0.6
  plot for [i=1:7] "smoothing.csv" using (of(body, i) ? 1000*$5 : NaN):6 skip 1 with linespoints lw 1.6 ps 0.9 dt d[i] \
    pt p[i] lc rgb c[i], \
    "" using (of(body, 4) && $4 == 20 ? 1000*$5 : NaN):6 skip 1 with points pt 6 ps 2.6 lw 1.5 lc rgb c[4]
  if (row == 2) { set xlabel "passes over the edges" offset 0,0.4 }
  set xrange [1.7:1200]
  set yrange [1e-3:100]
  set ytics (0.001, 0.01, 0.1, 1, 10, 100)
  set ylabel "|change of the volume| [%]"
  set title heading.": volume (dip: less becomes more)"
  plot for [i=1:7] "smoothing.csv" using (of(body, i) ? $4 : NaN):(abs($7)) skip 1 with linespoints lw 1.6 ps 0.9 dt d[i] \
    pt p[i] lc rgb c[i], "" using (of(body, 4) && $4 == 20 ? 20 : NaN):(abs($7)) skip 1 with points pt 6 ps 2.6 lw 1.5 lc rgb c[4]
  set yrange [0.03:400]
  set ytics (0.1, 1, 10, 100)
  set ylabel "drift along the surface [% of an edge]"
  set title heading.": drift"
  plot for [i=1:7] "smoothing.csv" using (of(body, i) ? $4 : NaN):8 skip 1 with linespoints lw 1.6 ps 0.9 dt d[i] pt p[i] \
    lc rgb c[i], "" using (of(body, 4) && $4 == 20 ? 20 : NaN):8 skip 1 with points pt 6 ps 2.6 lw 1.5 lc rgb c[4]
}
# The legend, below all.
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.055 center center horizontal maxrows 3 reverse Left samplen 3 spacing 1.15 width 1 font font.",11"
plot for [i=1:7] NaN with linespoints lw 1.6 ps 0.9 dt d[i] pt p[i] lc rgb c[i] title word(titles, i), \
  NaN with points pt 6 ps 2 lw 1.5 lc rgb c[4] title "the default: 10 pairs"
unset multiplot
