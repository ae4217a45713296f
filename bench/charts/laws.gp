# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "name='laws'; ending='svg'" laws.gp, in the folder of laws.csv
load style
@terminal
set output name.".".ending
laws = "paper uniform inverse van_gelder constant_strain"
titles = "'paper, k ∝ r' 'uniform' 'inverse, k ∝ 1/r' 'Van Gelder' 'triangles of constant strain'"
array c[5] = ["#D55E00", "#999999", "#56B4E9", "#0072B2", "#009E73"]
array p[5] = [7, 5, 9, 11, 13]
set multiplot layout 1,2 title "Law of the springs: what it costs and what it is worth (patch test, 26 columns)" \
  font font.",13"
set xlabel "longest stable step, dt / (h √(ρ/Y))    (right: cheaper)"
set xrange [0.2:0.56]
set key top left reverse Left opaque samplen 1.5 spacing 1.15
set label 1 "numbers: jitter of the mesh [h]" at graph 0.02,0.66 font font.",9" tc rgb "#555555"
set ylabel "error of the energy of a dilation [%]"
set yrange [-1:40]
plot for [i=1:5] "laws.csv" using ((strcol(1) eq word(laws, i)) ? $7 : NaN):(100*$4) skip 1 with linespoints lw 1.6 \
    ps 1.2 pt p[i] lc rgb c[i] title word(titles, i), \
  "laws.csv" using (($2 > 0 && (strcol(1) eq "paper" || strcol(1) eq "van_gelder" || strcol(1) eq "constant_strain")) ? $7 : NaN) \
    :(100*$4):(sprintf("%.1f", $2)) skip 1 with labels offset 1.6,0.6 font font.",9" tc rgb "#555555" notitle
unset key
unset label 1
set ylabel "part that is not affine, largest [strain × h]"
set yrange [-0.06:2.4]
plot for [i=1:5] "laws.csv" using ((strcol(1) eq word(laws, i)) ? $7 : NaN):6 skip 1 with linespoints lw 1.6 \
    ps 1.2 pt p[i] lc rgb c[i], \
  "laws.csv" using (($2 > 0 && (strcol(1) eq "paper" || strcol(1) eq "van_gelder" || strcol(1) eq "constant_strain")) ? $7 : NaN) \
    :6:(sprintf("%.1f", $2)) skip 1 with labels offset 1.6,0.6 font font.",9" tc rgb "#555555" notitle
unset multiplot
