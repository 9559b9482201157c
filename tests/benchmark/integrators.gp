# Error of both time integrators against the step, a panel per scene: gnuplot -e "file='orders.csv'; picture='x.png'" integrators.gp
set terminal pngcairo size 1160,360 font 'Helvetica,12' background 'white'
set output picture
set datafile separator ','
set logscale xy
set format y '10^{%T}'
set yrange [3e-8:1]
set xrange [1:25]
set xtics ('1.25' 1.25, '2.5' 2.5, '5' 5, '10' 10, '20' 20)
set xlabel 'step, ms'
set ylabel 'relative error'
set grid
unset key
scenes = 'cube_on_springs sliding_block rocking_block swinging_dome'
set multiplot layout 1,4
do for [scene in scenes] {
  name = system("echo '".scene."' | tr '_' ' '")
  set title name
  rows(which) = sprintf("< grep '^%s,%s,' %s | sed 's/^.*,\\([^,]*\\),\\([^,]*\\)$/\\1,\\2/'", name, which, file)
  set label 1 'implicit Euler' at graph 0.05, graph 0.95 textcolor '#b2182b'
  set label 2 'generalized alpha' at graph 0.97, graph 0.17 right textcolor '#2166ac'
  plot rows('euler') using 1:2 with linespoints pointtype 7 linewidth 2 linecolor '#b2182b', \
       rows('generalized_alpha') using 1:2 with linespoints pointtype 5 linewidth 2 linecolor '#2166ac'
  unset ylabel
}
unset multiplot
