#!/bin/sh
# Reproduces figures of the papers. A panel has a column for each run and a row for each time.
#
#     scenes/studies/paper-figures.sh FIGURE [FOLDER [SPACING]]
#
# FIGURE is one of
#
#     zhang-3     oscillating plate, og, oas, enog; von Mises stress
#     zhang-12    rings at 0.06 c0, og, oas, enog
#     zhang-14    rings at 0.08 c0, oas, enog
#     zhang-18    ball and plate at 0.02 c0, og, oas, enog; the paper states no times: the times here are ours
#     zhang-19    ball and plate at 0.06 c0, oas, enog
#     zhang-20    ball and plate at 0.12 c0, enog
#     khayyer-9   rotating plate, artificial stress of two strengths (ours) and tensile control; pressure
#     khayyer-10  rotating plate, artificial stress and tensile control at three spacings; SPACING is the coarsest
#     khayyer-12  rotating plate, path of the corner, as a history
#     khayyer-13  rotating plate, tensile control without and with artificial stress at the surface
#     lee-4       cable in 3D, pf, and pf-jst with harmonic dissipation 0, 1/32 and 1/8; pressure
#     lee-9       tensile cube, pf-jst with and without the exact boundary projection
#     lee-11      tensile cube, tl, pf and the three JST methods
#     lee-13      coining, pf and the three JST methods
#     lee-16      punch, ν = 0.499, tl, pf-jst, pfj-jst, pfhj-jst, and oenog
#     lee-18      punch cube, tl, pf, pf-jst, and oenog
#     lee-19      punch cube of Mooney–Rivlin rubber, ν = 0.495, pfj-jst, pfhj-jst
#     lee-23      bending column, ν = 0.499, three particles across, pf-jst, pfj-jst, and oenog
#     lee-25      twisting column with 4, 5, 6 and 7 particles across, pf-jst
#     lee-28      twisting column, ν = 0.499, pf-jst, pfj-jst, and oenog
#
# or PAPER.fig-N, such as Zhang2020.fig-7, for the curves of all claims about this figure (`taut claims PAPER` lists
# them): histories in FIGURE.png, and for each line that the scenes sample, a field along it in FIGURE-LINE.png.
#
#     scenes/studies/paper-figures.sh PAPER.fig-N [FOLDER [COLUMNS [TIMES]]]
#
# COLUMNS are columns of history.csv, such as tip or total_energy, joined by commas (default: all probes); TIMES are
# sampled times of the lines in s, joined by commas (default: all).
#
# FOLDER receives all files (default: out/FIGURE); SPACING is the particle spacing in m (default: as published, or
# nearly so; not for lee-25). Uses build/taut, or the program in TAUT.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
figure=${1:?which figure? the head of this script lists them}
folder=${2:-out/$figure}
spacing=${3:-}
times=${4:-}
runs=''

# run NAME SCENE METHOD [options of taut run]: runs into FOLDER/NAME, a column of the panel
run() {
  name=$1 scene=$2 method=$3
  shift 3
  "$taut" run "$scene" --method "$method" ${spacing:+--spacing "$spacing"} --no-render --save-particles \
    --fields "$field" --every "$every" --until "$until" --out "$folder/$name" "$@" >/dev/null ||
    [ $? -eq 3 ]   # a diverged run is part of the figure until it diverges
  runs="$runs $folder/$name"
}

# panel TIMES [WIDTHxHEIGHT]
panel() {
  # shellcheck disable=SC2086  # a list of folders whose names have no blanks
  "$taut" compare $runs --times "$1" --color $field ${2:+--size "$2"} --out "$folder/$figure.png"
}

# claims: runs the claims whose keys are fig-N, alone or followed by a letter or "-", and plots their curves
claims() {
  keys=$("$taut" claims "${figure%%.*}" --json | grep -oE "\"${figure%%.*}\.${figure#*.}([^0-9\"][^\"]*)?\"" | tr -d '"' | sort -u)
  [ -n "$keys" ] || { echo "$0: no claim is about '$figure'; see: taut claims ${figure%%.*}" >&2; exit 2; }
  # shellcheck disable=SC2086  # a list of names
  "$taut" claims --run $keys --out "$folder" || [ $? -eq 1 ]   # 1: a claim differs from its recorded state
  # shellcheck disable=SC2046
  "$taut" plot $(find "$folder" -name run.json -exec dirname {} \; | sort) ${spacing:+--columns "$spacing"} \
    --title "$figure" --out "$folder/$figure.png"
  for line in $(find "$folder" -name lines.csv -exec tail -qn +2 {} + | cut -d, -f1 | sort -u); do
    # shellcheck disable=SC2046
    "$taut" plot $(find "$folder" -name lines.csv -exec grep -l "^$line," {} + | xargs -n1 dirname | sort) \
      --lines "$line" ${times:+--times "$times"} --title "$figure" --out "$folder/$figure-$line.png" || [ $? -eq 2 ]   # 2: no sample at these times
  done
}

field=von_mises
case $figure in
  *.fig-*) claims ;;
  zhang-3)
    every=0.01 until=0.67
    for method in og oas enog; do run $method oscillating-plate $method; done
    panel 0.05,0.37,0.67 ;;
  zhang-12)
    every=1e-3 until=0.012
    for method in og oas enog; do run $method colliding-rings $method --set v0=0.06; done
    panel 0.002,0.005,0.008,0.012 ;;
  zhang-14)
    every=1e-3 until=0.012
    for method in oas enog; do run $method colliding-rings $method --set v0=0.08; done
    panel 0.002,0.005,0.008,0.012 ;;
  zhang-18)
    every=1e-3 until=0.03
    for method in og oas enog; do run $method ball-plate $method --set v0=0.02; done
    panel 0.008,0.015,0.022,0.03 ;;
  zhang-19)
    every=1e-3 until=0.016
    for method in oas enog; do run $method ball-plate $method --set v0=0.06; done
    panel 0.004,0.008,0.012,0.016 ;;
  zhang-20)
    every=1e-3 until=0.012
    run enog ball-plate enog --set v0=0.12
    panel 0.003,0.006,0.009,0.012 ;;
  khayyer-9)
    field=pressure every=0.01 until=0.15
    for epsilon in 0.15 0.3; do run as-$epsilon rotating-plate d-ulsph-r-as --set method.epsilon=$epsilon; done
    run tic rotating-plate d-ulsph-r-tic
    panel 0.09,0.15 ;;
  khayyer-10)
    field=pressure every=0.01 until=0.15 coarsest=${spacing:-0.08}
    for method in d-ulsph-r-as d-ulsph-r-tic; do
      for divisor in 1 2 4; do
        spacing=$(awk "BEGIN { print $coarsest / $divisor }")
        run $method-$divisor rotating-plate $method
      done
    done
    panel 0.15 ;;
  khayyer-12)
    field=pressure every=0.05 until=0.2
    run tic rotating-plate d-ulsph-r-tic
    echo "corner_x and corner_y over t: $folder/tic/history.csv" ;;
  khayyer-13)
    field=pressure every=0.01 until=0.15
    for share in 0 1; do run surface-$share rotating-plate d-ulsph-r-tic --set method.surface_artificial_stress=$share; done
    panel 0.09,0.15 ;;
  lee-4)
    field=pressure every=0.001 until=0.006
    run pf cable-3d pf
    for eps in 0 0.03125 0.125; do run eps-$eps cable-3d pf-jst --set method.eps_v2=$eps; done
    panel 0.006 1300x180 ;;
  lee-9)
    field=pressure every=1e-5 until=0.00212
    run projected tensile-cube pf-jst --set method.boundary_projection=1
    run plain tensile-cube pf-jst
    panel 0.00058,0.0017,0.0021 460x560 ;;
  lee-11)
    field=pressure every=1e-5 until=0.00212
    for method in tl pf pf-jst pfj-jst pfhj-jst; do run $method tensile-cube $method; done
    panel 0.00058,0.0017,0.0021 900x560 ;;
  lee-13)
    field=pressure every=1e-5 until=5.4e-4
    for method in pf pf-jst pfj-jst pfhj-jst; do run $method coining $method; done
    panel 0.00022,0.00054 1300x400 ;;
  lee-16)
    field=pressure every=3e-4 until=0.0135
    run tl punch tl
    run pf-jst punch pf-jst
    for method in pfj-jst pfhj-jst; do run $method punch $method --set method.eps_J4=0.125; done
    run oenog punch oenog
    panel 0.0051,0.0132 1300x460 ;;
  lee-18)
    field=pressure every=3e-4 until=0.0363
    for method in tl pf pf-jst oenog; do run $method punch-cube $method; done
    panel 0.0081,0.0213,0.036 580x480 ;;
  lee-19)
    field=pressure every=1e-4 until=0.0314
    for method in pfj-jst pfhj-jst; do
      run $method punch-cube $method --set law=mooney-rivlin --set poisson_ratio=0.495 --set method.eps_J4=0.125
    done
    panel 0.0083,0.0191,0.0313 560x800 ;;
  lee-23)
    # with three particles across, a breathing mode grows at the default time step
    field=pressure every=0.1 until=1.5 spacing=${spacing:-0.5}
    run pf-jst bending-column-3d pf-jst --set poisson_ratio=0.499 --set cfl=0.1
    run pfj-jst bending-column-3d pfj-jst --set poisson_ratio=0.499 --set cfl=0.1 --set method.eps_J4=0.125
    run oenog bending-column-3d oenog --set poisson_ratio=0.499
    panel 0.5,1,1.5 760x800 ;;
  lee-25)
    field=pressure every=0.1 until=0.1
    for across in 4 5 6 7; do
      spacing=$(awk "BEGIN { print 1 / ($across - 1) }")
      run across-$across twisting-column pf-jst
    done
    panel 0.1 660x390 ;;
  lee-28)
    field=pressure every=0.05 until=0.25 spacing=${spacing:-0.25}
    run pf-jst twisting-column pf-jst --set poisson_ratio=0.499
    run pfj-jst twisting-column pfj-jst --set poisson_ratio=0.499 --set method.eps_J4=0.125
    run oenog twisting-column oenog --set poisson_ratio=0.499
    panel 0.1,0.25 420x640 ;;
  *)
    echo "$0: unknown figure '$figure'; the header of this script lists the figures" >&2
    exit 2 ;;
esac
