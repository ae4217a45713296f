# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot keep.gp, in the folder of keep.csv
set datafile separator ","
set datafile commentschars "#"
set terminal pngcairo size 1200,640 font "DejaVu Sans,11"
set output "keep.png"
set border 3 lc rgb "#555555"
set tics nomirror
set grid ytics lc rgb "#dddddd"
rests = "flat drawn copied kept--no-help kept"
titles = "flat drawn copied 'kept, no help' kept"
array colour[5] = ["#999999", "#D55E00", "#E69F00", "#56B4E9", "#0072B2"]
rigidities = "1e-4 3e-5 1e-5"
heights = system("grep -v '^[#r]' keep.csv | cut -d, -f2 | uniq | sort -rn | uniq | paste -sd' ' -")
set multiplot layout 1,2 title "Share of its height that a ridge keeps (5 s; kept: and after a gust)" font ",13"
set yrange [-3:135]
set ylabel "% of the height as drawn"
set style fill solid
set boxwidth 0.17
x(i, m) = i + 0.19 * (m - 3)
do for [height in heights] {
  set title height." mm high" offset 0,-0.5
  set xtics ("10^{-4} N m" 1, "3·10^{-5}" 2, "10^{-5}" 3)
  set xrange [0.4:3.6]
  set key top right opaque
  # The bar is the mean of the three ridges, the points are the ridges.
  plot for [m=1:5] for [i=1:3] "keep.csv" using ((strcol(1) eq word(rigidities, i) && strcol(2) eq height && \
      strcol(3) eq word(rests, m)) ? x(i, m) : NaN):(100*($4+$5+$6)/3) skip 1 with boxes lc rgb colour[m] \
      title (i == 1 ? word(titles, m) : ""), \
    for [k=4:6] for [m=1:5] for [i=1:3] "keep.csv" using ((strcol(1) eq word(rigidities, i) && strcol(2) eq height && \
      strcol(3) eq word(rests, m)) ? x(i, m) : NaN):(100*column(k)) skip 1 with points pt 7 ps 0.6 lc rgb "#222222" notitle
}
unset multiplot
