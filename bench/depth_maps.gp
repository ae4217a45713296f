# SPDX-License-Identifier: GPL-3.0-or-later
# bench/charts/draw FOLDER depth_maps, of the depth_maps.csv there.
load style
@terminal
set output name.".".ending
ours(name) = strcol(1) eq name
maps(name) = strstrt(strcol(2), "maps") && ours(name)
# Labels stand above six maps, below two and three, but for one.
beside(name) = word(name, 1) eq "6" ? 1.45 : name eq "3 maps of 1024" ? 0.95 : 0.66
set multiplot layout 1,2 title "Colliders of a body of 14,286 triangles: what they cost, and where they are wrong" font font.",13"
set lmargin 10
set rmargin 5
set bmargin 5
set logscale xy
set xrange [2:2000]
set yrange [8:9000]
set xlabel "to make it anew for the next frame [ms]"
set ylabel "a question [ns]"
set key top right Left reverse samplen 1.5
plot "depth_maps.csv" using (maps("A") ? $5 : NaN):6 with points pt 7 ps 1.1 lc rgb "#0072B2" title "maps, arms out", \
  "" using (maps("arms in front") ? $5 : NaN):6 with points pt 6 ps 1.5 lw 1.5 lc rgb "#0072B2" title "maps, arms bent in front", \
  "" using (!maps("A") && ours("A") ? $5 : NaN):6 with points pt 9 ps 1.2 lc rgb "#D55E00" title "distance field, arms out", \
  "" using (!maps("arms in front") && ours("arms in front") ? $5 : NaN):6 with points pt 8 ps 1.6 lw 1.5 lc rgb "#D55E00" \
    title "distance field, arms bent in front", \
  "" using (maps("A") ? $5*(strcol(2) eq "3 maps of 1024" ? 2 : 1) : NaN):($6*beside(strcol(2))):(word(strcol(2), 1)." × ".word(strcol(2), 4)) \
    with labels font font.",8" tc rgb "#555555" title "labels: maps × pixels across"
unset logscale
set xrange [-0.6:6.6]
set yrange [0:5.2]
set xlabel ""
set ylabel "outside points called inside [%]"
set style fill solid 0.9 noborder
set xtics rotate by -25 font font.",9"
plot "depth_maps.csv" every ::1::7 using ($0 - 0.19):8:(0.36):xtic(2) with boxes lc rgb "#56B4E9" title "arms out", \
  "" every ::8::14 using ($0 + 0.19):8:(0.36) with boxes lc rgb "#D55E00" title "arms bent in front", \
  0.2 with lines lw 1.5 dt 2 lc rgb "#000000" title "from here simulate warns"
unset multiplot
