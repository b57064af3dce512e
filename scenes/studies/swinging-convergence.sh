#!/bin/sh
# Convergence of velocity and stress of the swinging cube, [Lee2016] Fig. 6, with and without boundary projection.
#
#     scenes/studies/swinging-convergence.sh [FOLDER]     # about 5 minutes on 2 cores; can be stopped and resumed
#
# Errors are RMS values over the particles and over four times, 1/8, 3/8, 5/8 and 7/8 of the period, when velocity and
# stress both differ from 0. The stress error uses all nine components. Prints errors in % of the maximum velocity and
# stress at those times, the order between successive spacings, and the order from the coarsest to the finest. Writes
# them to FOLDER (default: out/swinging-convergence) as convergence.dat and convergence.png. Uses build/taut, or the
# program in TAUT.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
folder=${1:-out/swinging-convergence}

# sweep NAME METHODS [options of taut sweep]. U0 is so small that a neo-Hookean cube is linear; the period is 16.0112
# ms
sweep() {
  name=$1 methods=$2
  shift 2
  "$taut" sweep swinging-cube --set U0=5e-6 "$@" --grid "method=$methods" --grid spacing=0.125,0.0625,0.03125 \
    --grid until=2.0014e-3,6.0042e-3,10.007e-3,14.0098e-3 --out "$folder/$name" >/dev/null
}
mkdir -p "$folder"
sweep plain tl,pf-jst,pfj-jst,pfhj-jst,oenog
sweep projected pf-jst --set method.boundary_projection=1

awk '
  function cut(line, field,    n, rest) {
    for (n = 0; line != ""; line = rest) {
      if (match(line, /^"([^"]|"")*"/)) { field[++n] = substr(line, 2, RLENGTH - 2); rest = substr(line, RLENGTH + 2) }
      else { match(line, /^[^,]*/); field[++n] = substr(line, 1, RLENGTH); rest = substr(line, RLENGTH + 2) }
    }
    return n
  }
  function order(from, to, steps) { return from > 0 && to > 0 ? sprintf("%.2f", log(from / to) / (steps * log(2))) : "-" }
  FNR == 1 { n = cut($0, head); for (k = 1; k <= n; ++k) at[head[k]] = k; series = FILENAME ~ /projected/ ? " projected" : ""; next }
  {
    cut($0, f)
    name = f[at["set.method"]] series; h = f[at["set.spacing"]]
    if (!(name in seen)) { seen[name] = 1; names[++count] = name }
    normal = f[at["measures.normal_stress_error.error"]]; shear = f[at["measures.shear_stress_error.error"]]
    # at nu = 0.3 the maximum shear stress over the maximum normal stress is (1 - 2 nu)/(1 + nu)
    v[name, h] += f[at["measures.velocity_error.error"]]^2 / 4
    s[name, h] += (normal^2 + 2.0 / 3 * (0.4 / 1.3 * shear)^2) / 4
  }
  END {
    for (k = 1; k <= count; ++k) {
      print "# " names[k] "\n# spacing, m; velocity, %; order; stress, %; order"
      last_v = last_s = 0
      for (h = 0.125; h > 0.03; h /= 2) {
        error_v = sqrt(v[names[k], h]); error_s = sqrt(s[names[k], h])
        printf "%-8s %7.3f %5s %7.3f %5s\n", h, 100 * error_v, order(last_v, error_v, 1), 100 * error_s, order(last_s, error_s, 1)
        if (h == 0.125) { first_v = error_v; first_s = error_s }
        last_v = error_v; last_s = error_s
      }
      printf "# over all: %s, %s\n\n\n", order(first_v, last_v, 2), order(first_s, last_s, 2)
    }
  }' "$folder"/plain/results.csv "$folder"/projected/results.csv | tee "$folder/convergence.dat"

gnuplot <<EOF
set terminal pngcairo size 1280,640 font ",11"
set output "$folder/convergence.png"
set multiplot layout 1,2 title "Swinging cube: errors over the period"
set logscale xy
set grid linecolor "#e4e4e4"
set xlabel "particle spacing, m"
set xtics (0.03125, 0.0625, 0.125)
set xrange [0.026:0.15]
set key bottom right
names = "tl pf-jst pfj-jst pfhj-jst oenog pf-jst,projected"
do for [k in "2 4"] {
  set ylabel (k eq "2" ? "velocity, % of the greatest" : "stress, % of the greatest")
  plot for [i = 1:6] "$folder/convergence.dat" index i-1 using 1:int(k) with linespoints linewidth 2 pointtype (i == 6 ? 6 : i) pointsize (i == 6 ? 2.5 : 1.2) title word(names, i), \
       200 * x**2 with lines dashtype 2 linecolor "#a0a0a0" title "order 2"
}
unset multiplot
EOF
