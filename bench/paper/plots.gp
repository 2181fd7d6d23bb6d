# Draws the figures from the tables of a run: gnuplot -c plots.gp FOLDER. Writes FOLDER/*.svg.
set encoding utf8
set datafile separator comma
folder = ARG1
dash = "–"

set terminal svg size 760,360 font "sans-serif,13" background "#ffffff"
set logscale xy
set format y "10^{%T}"
set grid xtics ytics linecolor "#dddddd"
set key outside right top samplen 2 spacing 1.1
set tics nomirror
set border 3

# Lines of one kind per surface, full for rms, dashed for maxima.
set linetype 1 linecolor "#9a9a9a" linewidth 1.6 pointtype 4 pointsize 0.6
set linetype 2 linecolor "#d1730b" linewidth 1.6 pointtype 8 pointsize 0.7
set linetype 3 linecolor "#0b5fa5" linewidth 1.8 pointtype 7 pointsize 0.5
surfaces = "linear manson plic"

# A column of a table where body and surface are those wanted.
of(body, surface, column) = strcol(1) eq body && strcol(4) eq surface ? column(column) : NaN

first_number(file, body, surface, column) = \
  real(system(sprintf("awk -F, '$1 == \"%s\" && $4 == \"%s\" {print $%d; exit}' '%s'", \
    body, surface, column, file)))

sphere = folder . "/sphere.csv"
set xtics (8, 10, 12, 16, 20, 25, 32, 40, 50, 64, 128)
set xrange [7.5:136]
set xlabel "R/Δx"

set output folder . "/sphere_distance.svg"
set ylabel "distance from the sphere, R"
start = first_number(sphere, "sphere", "plic", 7)
plot for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 7)) \
       with linespoints linetype n title word(surfaces, n) . ", rms", \
     for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 8)) \
       with linespoints linetype n dashtype 2 title word(surfaces, n) . ", max", \
     0.6 * start * (8 / x) ** 2 with lines linecolor "#333333" dashtype 3 title "slope 2", \
     20 * start * (8 / x) with lines linecolor "#333333" dashtype 4 title "slope 1"

set output folder . "/sphere_curvature.svg"
set ylabel "error of mean curvature, 1/R"
plot for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 11)) \
       with linespoints linetype n title word(surfaces, n) . ", rms", \
     for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 12)) \
       with linespoints linetype n dashtype 2 title word(surfaces, n) . ", max"

set output folder . "/sphere_gaussian.svg"
set ylabel "error of Gaussian curvature, 1/R²"
plot for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 14)) \
       with linespoints linetype n title word(surfaces, n) . ", rms", \
     for [n = 1:3] sphere using 3:(of("sphere", word(surfaces, n), 15)) \
       with linespoints linetype n dashtype 2 title word(surfaces, n) . ", max"

# One small plot per other body; colours and lines are said once, above.
bodies = folder . "/bodies.csv"
list(condition) = system(sprintf( \
  "awk -F, 'NR > 1 && %s && !seen[$1]++ {gsub(/ /, \"_\", $1); printf \"%%s \", $1}' '%s'", \
  condition, bodies))
set terminal svg size 900,560 font "sans-serif,12" background "#ffffff"
set xtics (25, 50, 100, 200)
set xrange [22:230]
set xlabel "D/Δx"
set mytics 1
unset key
set label 1 "linear" at screen 0.36,0.975 textcolor "#9a9a9a"
set label 2 "manson" at screen 0.43,0.975 textcolor "#d1730b"
set label 3 "plic" at screen 0.51,0.975 textcolor "#0b5fa5"
set label 4 "full: rms, dashed: max" at screen 0.56,0.975

drawing(n) = system(sprintf("echo '%s' | tr _ ' '", word(names, n)))
do for [what = 1:2] {
  first = what == 1 ? 7 : 11
  names = list(what == 1 ? "1" : "$11 > 0")
  columns = what == 1 ? 3 : 2
  set output folder . (what == 1 ? "/bodies_distance.svg" : "/bodies_curvature.svg")
  set multiplot layout 2,columns margins 0.08,0.98,0.10,0.90 spacing 0.07,0.16
  do for [b = 1:words(names)] {
    body = drawing(b)
    set title body
    set ylabel b % columns == 1 ? (what == 1 ? "distance, D" : "error of mean curvature, 1/D") : ""
    plot for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), first)) \
           with linespoints linetype n, \
         for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), first + 1)) \
           with linespoints linetype n dashtype 2
  }
  unset multiplot
}
