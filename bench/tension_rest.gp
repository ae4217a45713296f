# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot bench/tension_rest.gp, in the folder of tension_rest.csv: tension_rest.svg and .png
set datafile separator ","
set datafile commentschars "#"
set border 3 lc rgb "#555555"
set tics nomirror
set grid lc rgb "#dddddd" lt 1 lw 0.6
set key left top reverse Left
set xlabel "strain [%]"
set ylabel "load [mN]"
set title "Quadratic tension, c = 10 N, loaded and unloaded; settled until the net force is below f:\nwithout load sqrt(f/c) remains"
do for [ending in "svg png"] {
  if (ending eq "svg") { set terminal svg size 720,460 font "DejaVu Sans,11" background "white" } else { set terminal pngcairo size 720,460 font "DejaVu Sans,11" }
  set output "tension_rest.".ending
  plot "tension_rest.csv" using ($1==0.001 ? 100*$3 : NaN):(1000*$2) with lines lw 2 lc rgb "#D55E00" title "f = 1 mN: 1 %", \
    "" using ($1==0.0001 ? 100*$3 : NaN):(1000*$2) with lines lw 2 lc rgb "#0072B2" title "f = 0.1 mN: 0.32 %", \
    "" using ($1==1e-05 ? 100*$3 : NaN):(1000*$2) with lines lw 2 lc rgb "#009E73" title "f = 0.01 mN: 0.1 %", \
    "" using ($1==1e-05 ? 100*$4 : NaN):(1000*$2) with lines lw 1 dt 2 lc rgb "#000000" title "in balance: the law"
}
