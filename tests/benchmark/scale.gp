# Time and memory of the static Brunelleschi model over the number of blocks.
set terminal pngcairo size 720,480 font 'Helvetica,11' background 'white'
set output folder.'/scale.png'
set datafile separator ','
set logscale xy
set xlabel 'blocks'
set ylabel 'CPU s, GB'
set title 'Static solve of the Brunelleschi model, including reading and writing'
set key outside bottom center maxrows 3
set grid
file = folder.'/scale.csv'
sector(n) = column(2) == 8 ? column(n) : NaN
full(n) = column(2) == 1 ? column(n) : NaN
plot file skip 1 using 3:(full(6)) with linespoints title 'CPU s', \
     file skip 1 using 3:(full(7)) with linespoints title 'GB', \
     file skip 1 using 3:(sector(6)) with linespoints title 'CPU s, one of 8 sectors', \
     file skip 1 using 3:(sector(7)) with linespoints title 'GB, one of 8 sectors', \
     file skip 1 using 3:(full(3) / 1e3) with lines dashtype 3 linecolor 'gray40' title 'proportional'
