# SPDX-License-Identifier: GPL-3.0-or-later
# What all charts share. Okabe and Ito's colours, told apart by the colour-blind; law or method also by its marker.
set datafile separator ","
set datafile commentschars "#"
set border 3 lc rgb "#555555"
set tics nomirror
set grid lc rgb "#dddddd" lt 1 lw 0.6
set bars 0
font = "DejaVu Sans"
array colour[8] = ["#000000", "#999999", "#0072B2", "#D55E00", "#CC79A7", "#56B4E9", "#009E73", "#E69F00"]
array closed[8] = [7, 5, 7, 9, 13, 11, 5, 11]
array open[8] = [6, 4, 6, 8, 12, 10, 4, 10]
