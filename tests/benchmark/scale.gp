# Time and memory of the static Brunelleschi model over its blocks.
set terminal pngcairo size 720,480 font 'Helvetica,11' background 'white'
set output folder.'/scale.png'
set datafile separator ','
set logscale xy
set xlabel 'blocks'
set ylabel 'CPU s, GB'
set title 'Static solve of the Brunelleschi model, reading and writing included'
set key top left
set grid
file = folder.'/scale.csv'
plot file skip 1 using 2:5 with linespoints title 'CPU seconds', \
     file skip 1 using 2:6 with linespoints title 'GB', \
     file skip 1 using 2:(column(2) / 1e3) with lines dashtype 3 title 'in proportion to the blocks'
