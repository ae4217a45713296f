# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='fields'; ..." fields.gp, in the folder of fields.csv
load style
@terminal
set output name.".".ending
fields = "adaptive uniform openvdb openvdb_3_voxels"
array c[4] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"]
array p[4] = [7, 5, 9, 11]
array o[4] = [6, 4, 8, 10]
peer = int(system("grep -c ',openvdb,' fields.csv")) > 0
set multiplot layout 3,3 title "Fields of signed distance: error against build time, memory and query time (one thread; points: tolerances or cells)" \
  font font.",13" margins 0.06,0.985,0.125,0.935 spacing 0.055,0.075
set logscale xy
unset mytics
unset mxtics
unset key
set ytics (0.03, 0.1, 0.3, 1, 3, 10, 30)
row = 0
do for [panel in "ball|band mannequin|band mannequin|near"] {
  row = row + 1
  near = row == 3
  body = row == 1 ? "ball" : "mannequin"
  heading = row == 1 ? "ball, in the band" : row == 2 ? "mannequin, in the band" : "mannequin, within 5 mm of the surface"
  largest = near ? 14 : 11
  tail = near ? 15 : 12
  last = near ? 4 : 3
  of(i) = strcol(1) eq body && strcol(3) eq word(fields, i)
  set yrange [(row == 1 ? 0.03 : 0.4):(row == 1 ? 2.5 : near ? 20 : 40)]
  do for [cost in "5 6 7"] {
    of_cost = int(cost)
    factor = of_cost == 6 ? 1e-6 : 1
    set title heading offset 0,-0.6
    if (of_cost == 5) { set ylabel "error [mm]" offset 1.2,0; set xrange [0.04:8]; set xtics (0.05, 0.1, 0.2, 0.5, 1, 2, 5) }
    if (of_cost == 6) { unset ylabel; set xrange [0.03:100]; set xtics (0.1, 1, 10, 100) }
    if (of_cost == 7) { set xrange [8:400]; set xtics (10, 20, 50, 100, 200) }
    if (row == 3) { set xlabel (of_cost == 5 ? "build [CPU s]" : of_cost == 6 ? "memory [MB]" : "query [CPU ns]") offset 0,0.4 } \
    else { unset xlabel }
    # OpenVDB offers the value without the gradient for a little less.
    query(i, k) = i > 2 ? column(k + 2) : column(k)
    if (of_cost < 7) {
      plot for [i=1:last] "fields.csv" using (of(i) ? factor*column(of_cost) : NaN):(1e3*column(largest)) skip 1 \
          with linespoints lw 1.6 ps 0.9 pt p[i] lc rgb c[i], \
        for [i=1:last] "fields.csv" using (of(i) ? factor*column(of_cost) : NaN):(1e3*column(tail)) skip 1 \
          with linespoints lw 1.2 ps 0.7 dt 3 pt o[i] lc rgb c[i], \
        "" using (of(1) && $17 == 1 ? factor*column(of_cost) : NaN):(1e3*column(largest)) skip 1 with points pt 6 \
          ps 2.6 lw 1.5 lc rgb c[1]
    } else {
      plot for [i=1:last] "fields.csv" using (of(i) ? query(i, 7) : NaN):(1e3*column(largest)) skip 1 \
          with linespoints lw 1.6 ps 0.9 pt p[i] lc rgb c[i], \
        for [i=1:last] "fields.csv" using (of(i) ? query(i, 8) : NaN):(1e3*column(largest)) skip 1 \
          with linespoints lw 1.2 ps 0.7 dt 3 pt o[i] lc rgb c[i], \
        "" using (of(1) && $17 == 1 ? query(1, 7) : NaN):(1e3*column(largest)) skip 1 with points pt 6 \
          ps 2.6 lw 1.5 lc rgb c[1]
    }
  }
}
# The legend, below all.
unset title; unset xlabel; unset ylabel; unset border; unset tics; unset grid; unset logscale
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.08
set xrange [0:1]
set yrange [0:1]
set key at screen 0.5,0.04 center center horizontal maxrows 2 reverse Left samplen 3 spacing 1.15 width 1 font font.",11"
plot NaN with linespoints lw 1.6 pt p[1] lc rgb c[1] title "Furrow's adaptive field (ring: default tolerance)", \
  NaN with linespoints lw 1.6 pt p[2] lc rgb c[2] title "uniform grid", \
  NaN with linespoints lw 1.6 pt p[3] lc rgb c[3] title (peer ? "OpenVDB, the same band (value only)" : "OpenVDB, the same band: not measured"), \
  NaN with linespoints lw 1.6 pt p[4] lc rgb c[4] title (peer ? "OpenVDB, 3 voxels (value only)" : "OpenVDB, 3 voxels: not measured"), \
  NaN with linespoints lw 1.6 pt 7 lc rgb "#555555" title "largest error; query: in no order", \
  NaN with linespoints lw 1.2 dt 3 pt 6 lc rgb "#555555" title "99.9 percentile; query: along a curve"
unset multiplot
