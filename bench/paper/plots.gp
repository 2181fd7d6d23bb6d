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
set xtics (8, 10, 12, 16, 20, 25, 32, 40, 50, 64)
set xrange [7.5:68]
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

# One small plot per other body.
bodies = folder . "/bodies.csv"
names = system(sprintf("awk -F, 'NR > 1 && !seen[$1]++ {gsub(/ /, \"_\", $1); printf \"%%s \", $1}' '%s'", bodies))
name(n) = system(sprintf("echo '%s' | tr _ ' '", word(names, n)))
set terminal svg size 900,560 font "sans-serif,12" background "#ffffff"
set xtics (25, 50, 100, 200)
set xrange [22:230]
set xlabel "D/Δx"
set key inside left bottom samplen 1.5 spacing 1.0 font ",10"

set output folder . "/bodies_distance.svg"
set multiplot layout 2,3
do for [b = 1:words(names)] {
  body = name(b)
  set title body
  set ylabel b % 3 == 1 ? "distance, D" : ""
  plot for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), 7)) \
         with linespoints linetype n title b == 1 ? word(surfaces, n) . ", rms" : "", \
       for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), 8)) \
         with linespoints linetype n dashtype 2 title b == 1 ? word(surfaces, n) . ", max" : ""
}
unset multiplot

curved = system(sprintf("awk -F, 'NR > 1 && $11 > 0 && !seen[$1]++ {gsub(/ /, \"_\", $1); printf \"%%s \", $1}' '%s'", bodies))
names = curved
set terminal svg size 900,560 font "sans-serif,12" background "#ffffff"
set output folder . "/bodies_curvature.svg"
set multiplot layout 2,2
do for [b = 1:words(names)] {
  body = name(b)
  set title body
  set ylabel b % 2 == 1 ? "error of mean curvature, 1/D" : ""
  plot for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), 11)) \
         with linespoints linetype n title b == 1 ? word(surfaces, n) . ", rms" : "", \
       for [n = 1:3] bodies using 3:(of(body, word(surfaces, n), 12)) \
         with linespoints linetype n dashtype 2 title b == 1 ? word(surfaces, n) . ", max" : ""
}
unset multiplot
