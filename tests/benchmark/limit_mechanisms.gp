# The mechanisms of limit analyses side by side: gnuplot -e "files='A.png B.png'; titles='a b'; picture='C.png'" FILE.
# Of every picture of 1000 x 700 pixels the middle is shown, without margins and label.
set terminal pngcairo size 1600,760 font 'Helvetica,13' background 'white'
set output picture
set multiplot layout 2,(words(files) + 1) / 2 margins 0.002,0.998,0.002,0.95 spacing 0.002,0.05
unset border
unset tics
unset key
set size ratio -1
set xrange [150:850]
set yrange [70:690]
do for [i = 1:words(files)] {
  set title word(titles, i) noenhanced offset 0,-0.5
  plot word(files, i) binary filetype=png with rgbimage
}
unset multiplot
