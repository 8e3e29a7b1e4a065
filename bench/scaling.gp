# The scaling chart, from scaling.csv in the current folder: time per disk and step, and speed-up, against the number of
# disks.
set datafile separator ','
set terminal svg size 900,640 font 'sans-serif,15' enhanced background 'white'
set output 'scaling.svg'
set border 3 lc rgb '#555555'
set tics nomirror out scale 0.5 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lt 1 lw 0.6
set logscale x
set format x '10^{%L}'
set xrange [7e3:4e7]
unset key
set multiplot title 'A step of scene G: equal disks, packing fraction 0.5' font 'sans-serif,18'

set lmargin at screen 0.10
set rmargin at screen 0.80
set tmargin at screen 0.90
set bmargin at screen 0.42
set yrange [0:*]
set format x ''
set ylabel 'ns per disk and step'
last(column) = system(sprintf("tail -n 1 scaling.csv | cut -d, -f%d", column)) + 0
set label 1 'step, 1 thread' at 1.25e7,last(2) textcolor rgb '#0072b2'
set label 2 'step, 2 threads' at 1.25e7,last(3) textcolor rgb '#d55e00'
set label 3 'copy, 1 thread' at 1.25e7,last(4) offset 0,0.5 textcolor rgb '#56b4e9'
set label 4 'copy, 2 threads' at 1.25e7,last(5) offset 0,-0.5 textcolor rgb '#e69f00'
plot 'scaling.csv' skip 1 using 1:2 with linespoints pt 7 lw 2 lc rgb '#0072b2', \
     '' skip 1 using 1:3 with linespoints pt 7 lw 2 lc rgb '#d55e00', \
     '' skip 1 using 1:4 with linespoints pt 6 dt 2 lw 1.5 lc rgb '#56b4e9', \
     '' skip 1 using 1:5 with linespoints pt 6 dt 2 lw 1.5 lc rgb '#e69f00'

unset label
set tmargin at screen 0.34
set bmargin at screen 0.11
set yrange [0.8:2.05]
set ytics 0.2
set format x '10^{%L}'
set xlabel 'disks'
set ylabel 'speed-up, 2 threads'
set label 5 'promised: 1.8' at 1.25e7,1.8 textcolor rgb '#777777'
set arrow 5 from 7e3,1.8 to 1.2e7,1.8 nohead dt 3 lw 1.5 lc rgb '#777777'
plot 'scaling.csv' skip 1 using 1:6 with linespoints pt 7 lw 2 lc rgb '#000000'
unset multiplot
