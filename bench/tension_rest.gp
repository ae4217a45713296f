# SPDX-License-Identifier: GPL-3.0-or-later
# bench/charts/draw FOLDER tension_rest, of the tension_rest.csv there.
load style
@terminal
set output name.".".ending
set key left top reverse Left
set xlabel "strain [%]"
set ylabel "load [mN]"
set title "Quadratic tension, c = 10 N, loaded and unloaded; settled until the net force is below f:\nwithout load sqrt(f/c) remains"
plot "tension_rest.csv" using ($1==0.001 ? 100*$3 : NaN):(1000*$2) with lines lw 2 lc rgb "#D55E00" title "f = 1 mN", \
  "" using ($1==0.0001 ? 100*$3 : NaN):(1000*$2) with lines lw 5 lc rgb "#56B4E9" title "f = 0.1 mN", \
  "" using ($1==1e-05 ? 100*$3 : NaN):(1000*$2) with lines lw 2.5 lc rgb "#009E73" title "f = 0.01 mN", \
  "" using ($1==1e-05 ? 100*$4 : NaN):(1000*$2) with lines lw 1 dt 2 lc rgb "#000000" title "in balance: the law"
