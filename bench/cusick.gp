# SPDX-License-Identifier: GPL-3.0-or-later
# bench/charts/draw FOLDER cusick, of the cusick.csv there.
load style
@terminal
set output name.".".ending
set key outside below vertical maxrows 4 reverse Left samplen 2.5 width 1
set logscale x
set xrange [9:90]
set yrange [0:1]
set xtics (10, 12.5, 16, 20, 25, 32, 40, 50, 64, 80)
set xlabel "bending length c = (B / weight)^{1/3} of the hinges' stiffness [mm]"
set ylabel "drape coefficient DC [-]"
set title "Cusick's drape test, specimen 30 cm, discs 18 cm: all starts (5 to 9 folds), cells of 7.5 mm"
$elastic << end
10,0.235
12.5,0.314
16,0.495
20,0.665
25,0.806
32,0.896
end
# Measured fabrics, after the targets of ppf-contact-solver (st-tech): silk 0.20 to 0.40, cotton 0.60 to 0.76.
set object 1 rectangle from graph 0, first 0.20 to graph 1, first 0.40 fc rgb "#56B4E9" fs transparent solid 0.15 noborder behind
set object 2 rectangle from graph 0, first 0.60 to graph 1, first 0.76 fc rgb "#E69F00" fs transparent solid 0.15 noborder behind
mine(what, law) = strcol(1) eq what && strcol(2) eq law ? $3 : NaN
plot $elastic using 1:($2-0.05):($2+0.05) with filledcurves fc rgb "#999999" fs transparent solid 0.35 noborder \
    title "elastic curve ± 0.05", \
  "" using 1:2 with lines lw 2 lc rgb "#000000" title "elastic curve (another program)", \
  NaN with filledcurves fc rgb "#56B4E9" fs transparent solid 0.15 noborder title "measured of silk", \
  NaN with filledcurves fc rgb "#E69F00" fs transparent solid 0.15 noborder title "measured of cotton", \
  "cusick.csv" using (mine("settled", "linear")):6 with points pt 7 ps 0.7 lc rgb "#0072B2" title "linear hinges: settle", \
  "" using (mine("moved", "linear")):6 with points pt 6 ps 1.5 lw 1.5 lc rgb "#0072B2" \
    title "linear hinges: leapfrog, then settle", \
  "" using (mine("settled", "cosine")):6 with points pt 9 ps 0.8 lc rgb "#D55E00" title "cosine hinges: settle", \
  "" using (mine("moved", "cosine")):6 with points pt 8 ps 1.6 lw 1.5 lc rgb "#D55E00" \
    title "cosine hinges: leapfrog, then settle"
