# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot bench/depth_maps.gp, in the folder of depth_maps.csv: depth_maps.svg and .png
set datafile separator ","
set border 3 lc rgb "#555555"
set tics nomirror
set grid lc rgb "#dddddd" lt 1 lw 0.6
ours(name) = strcol(1) eq name
maps(name) = strstrt(strcol(2), "maps") && ours(name)
do for [ending in "svg png"] {
  if (ending eq "svg") { set terminal svg size 980,420 font "DejaVu Sans,11" background "white" } else { set terminal pngcairo size 980,420 font "DejaVu Sans,11" }
  set output "depth_maps.".ending
  set rmargin 6
  set multiplot layout 1,2 title "Colliders of a body of 14,286 triangles: what they cost, and where they are wrong"
  unset logscale
  set logscale xy
  set xrange [2:2000]
  set yrange [8:1500]
  set xtics auto rotate by 0
  set ytics auto
  set xlabel "to make it anew for the next frame [ms]"
  set ylabel "a question [ns]"
  set key top right
  plot "depth_maps.csv" using (maps("A") ? $5 : NaN):6 with points pt 7 ps 1.1 lc rgb "#0072B2" title "maps, arms out", \
    "" using (maps("arms in front") ? $5 : NaN):6 with points pt 6 ps 1.5 lw 1.5 lc rgb "#0072B2" title "maps, arms bent in front", \
    "" using (!maps("A") && ours("A") ? $5 : NaN):6 with points pt 9 ps 1.2 lc rgb "#D55E00" title "distance field, arms out", \
    "" using (!maps("arms in front") && ours("arms in front") ? $5 : NaN):6 with points pt 8 ps 1.6 lw 1.5 lc rgb "#D55E00" title "distance field, arms bent", \
    "" using (maps("A") ? $5 : NaN):($6 / 1.35):(word(strcol(2), 1)." of ".word(strcol(2), 4)) with labels font ",8" tc rgb "#555555" notitle
  unset logscale
  set xrange [-0.6:6.6]
  set yrange [0:5.2]
  set xlabel ""
  set ylabel "outside points called inside [%]"
  set style fill solid 0.9 noborder
  set xtics rotate by -40
  set key top right
  plot "depth_maps.csv" every ::1::7 using ($0 - 0.19):8:(0.36):xtic(2) with boxes lc rgb "#56B4E9" title "arms out", \
    "" every ::8::14 using ($0 + 0.19):8:(0.36) with boxes lc rgb "#D55E00" title "arms bent in front", \
    0.2 with lines lw 1.5 dt 2 lc rgb "#000000" title "from here simulate warns"
  unset multiplot
}
