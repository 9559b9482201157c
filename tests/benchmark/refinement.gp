# Largest change of the wrench of a macro-block against the finest bricks, over the number of bricks along an edge.
set terminal pngcairo size 760,480 font 'Helvetica,11' background 'white'
set output folder.'/refinement.png'
set datafile separator ','
set logscale x 2
set logscale y
set format y '10^{%T}'
set xlabel 'bricks along an edge of a macro-block (bond.refine)'
set ylabel 'largest relative change against the finest bricks'
set title 'Wrench of a macro-block and sum over its bricks, circular dome'
set key outside right
set grid
file = folder.'/refinement.csv'
plot for [level in '0 10 20 30'] file using (column(1) == level && column(6) > 0 ? column(2) : NaN):6 \
       with linespoints title 'force, course '.level, \
     for [level in '0 10 20 30'] file using (column(1) == level && column(7) > 0 ? column(2) : NaN):7 \
       with linespoints dashtype 2 title 'moment, course '.level
