# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# What all plots share. Colours can be told apart by the colour-blind (Okabe and
# Ito); a number stands for the same enforcement in every plot:
#   1 skew Nitsche (default)   2 symmetric Nitsche   3 augmented Lagrangian
#   4 weighted (Cortis et al. 2017)     5 penalty
#   8 published or exact       9 guides
set linetype 1 lc rgb '#0072B2' lw 2.5 pt 7 ps 1.4
set linetype 2 lc rgb '#56B4E9' lw 2.5 pt 5 ps 1.3
set linetype 3 lc rgb '#009E73' lw 2.5 pt 9 ps 1.5
set linetype 4 lc rgb '#D55E00' lw 2.5 pt 11 ps 1.5
set linetype 5 lc rgb '#CC79A7' lw 2.5 pt 13 ps 1.6
set linetype 6 lc rgb '#E69F00' lw 2.5 pt 4 ps 1.4
set linetype 7 lc rgb '#555555' lw 2.5 pt 6 ps 1.4
set linetype 8 lc rgb '#000000' lw 2 pt 2 ps 1.8
set linetype 9 lc rgb '#888888' lw 1.5 dt 2
set datafile separator ','
set datafile missing NaN
set grid lc rgb '#dddddd' lt 1 lw 1
set border lw 1.2
# The empty title of the key keeps it off the label of the axis.
set key below center vertical Left reverse maxrows 3 spacing 1.2 samplen 2.5 \
        title ' ' font ',5'
set xlabel offset 0,0.4

# As make_figures.sh names the enforcements in a study, and in words.
array Name[5] = ['skew Nitsche 10', 'symmetric Nitsche 20', 'augmented Lagrangian 1e-6', \
                 'weighted 1e-6 of places', 'penalty 1e6']
array Title[5] = ['skew Nitsche, γ = 10 (default)', 'symmetric Nitsche, γ = 20', \
                  'augmented Lagrangian, 1e-6 h', \
                  'weighted, 1e-6 h, every place (paper)', \
                  'penalty, β = 1e6']

# The value where the rows of a study are of this series, else nothing.
of(name, value) = strcol('Series') eq name ? value : NaN
