# The mechanisms of limit analyses side by side: gnuplot -e "files='A.png B.png'; titles='a b'; picture='C.png'" FILE.
set terminal pngcairo size 1500,640 font 'Helvetica,11' background 'white'
set output picture
set multiplot layout 2,(words(files) + 1) / 2 margins 0.005,0.995,0.005,0.95 spacing 0.005,0.06
unset border
unset tics
unset key
set size ratio -1
do for [i = 1:words(files)] {
  set title word(titles, i) noenhanced
  plot word(files, i) binary filetype=png with rgbimage
}
unset multiplot
