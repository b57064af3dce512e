#!/usr/bin/env bash
# Runs the scenes of the papers with several methods, and compares the results in tables.
#
#     scenes/studies/paper-tables.sh                    # all, into results/paper-tables.md; some minutes
#     scenes/studies/paper-tables.sh FILE SECTION ...   # some sections, such as punch, into FILE
#
# Uses build/taut, or the program in TAUT.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
to=$(realpath -m "${1:-$here/results/paper-tables.md}")
sections=("${@:2}")
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT

# run COMMAND: prints the folder of the run; equal commands run once
run() {
  local folder
  folder=$runs/$(md5sum <<<"$1" | cut -c-32)
  if [[ ! -e $folder ]]; then
    echo "$1" >&2
    # shellcheck disable=SC2086  # options without blanks
    "$taut" ${1#taut } --no-render --quiet --out "$folder" >/dev/null 2>"$runs/said" || case $? in
      2) cat "$runs/said" >&2; mkdir "$folder" ;;  # refused: a dash in the table
      3) ;;                  # diverged
      *) cat "$runs/said" >&2; exit 1 ;;
    esac
  fi
  echo "$folder"
}

# cell RUN QUANTITY,...: QUANTITY is verdict, zigzag, alternating, alternating_last, a measure, or MEASURE% for its error
cell() {
  [[ -e $1/run.json ]] || { echo -; return; }
  awk -v quantities="$2" '
    function percent(x, sign) { return sprintf("%" sign (x < 99.5 && x > -99.5 ? ".2g" : ".0f") " %%", x) }
    function shown(q,    name, value, reference, unit) {
      if (q == "verdict") return "`" of["", "verdict"] "`"
      if (q == "zigzag") return sprintf("%.2g", of["hourglass_error", "greatest"])
      if (q == "alternating") return percent(100 * of["pressure_checkerboard", "greatest"])
      if (q == "alternating_last") return percent(100 * of["pressure_checkerboard", "last"])
      name = q; sub(/%$/, "", name)
      value = of[name, "value"]; reference = of[name, "reference"]; unit = of[name, "unit"]
      if (value == "") { print "no measure " name " in " FILENAME > "/dev/stderr"; exit 1 }
      if (value == "null" || of["", "verdict"] == "diverged") return "-"
      if (q ~ /%$/ && reference == "null") { print "no reference for " name " in " FILENAME > "/dev/stderr"; exit 1 }
      value += 0
      if (q ~ /%$/ && reference == 0) return percent(100 * value)
      if (q ~ /%$/) return percent(100 * (value - reference) / (reference < 0 ? -reference : reference), "+")
      if ((unit == "m" || unit == "s") && value < 1 && value > -1) { value *= 1000; unit = "m" unit }
      return sprintf("%.4g", value) (unit == "1" ? "" : " " unit)
    }
    { key = $1; gsub(/[":]/, "", key); text = $2; gsub(/[",]/, "", text) }
    /^  "/ { of["", key] = text }
    /^    "[^"]*": \{/ { inside = key }
    /^      "/ { of[inside, key] = text }
    END {
      n = split(quantities, q, ",")
      line = shown(q[1])
      for (k = 2; k <= n && line != "-"; ++k) line = line ", " shown(q[k])
      print line
    }' "$1/run.json"
}

# column HEAD QUANTITY,... SCENE [options]: adds a column to the next table
columns=()
column() { columns+=("$1|$2|${*:3}"); }

# every SCENE QUANTITY,... ...: adds a column for each, with the first quantity as head
every() {
  local quantity
  for quantity in "${@:2}"; do column "\`${quantity%%,*}\`" "$quantity" "$1"; done
}

# table ROW ...: prints a table; ROW is a method with options
table() {
  local row column rest folder line
  printf '\n| |'; printf ' %s |' "${columns[@]%%|*}"; printf '\n|---|'; printf -- '---|%.0s' "${columns[@]}"; echo
  for row; do
    line="| \`$row\` |"
    for column in "${columns[@]}"; do
      rest=${column#*|}
      folder=$(run "taut run ${rest#*|} --method $row")
      line+=" $(cell "$folder" "${rest%%|*}") |"
    done
    echo "$line"
  done
  columns=()
}

# section NAME [TEXT]: prints the head of a section; fails if it is not wanted
section() {
  if ((${#sections[@]})) && [[ " ${sections[*]} " != *" $1 "* ]]; then return 1; fi
  printf '\n## %s\n' "$1"
  if (($# > 1)); then printf '\n%s\n' "$2"; fi
}

pages() {
  echo "# Scenes of the papers: results of several methods"
  echo
  echo "Made by \`paper-tables.sh\`; do not edit. A row is \`taut run SCENE --method ROW\`, with the scene of the heading, or"
  echo "the scene and options that the text states. Percentages of measures are differences from the reference of the scene"
  echo "for the law of the method, positive if the value is greater; of \`rmse\` measures they are the value. Zigzag:"
  echo "greatest \`hourglass_error\`; alternating: greatest part of the pressure that alternates between particles;"
  echo "\`alternating_last\`: at the end. A dash: the run diverged, the measure has no value, or the method refuses the scene."

  if section colliding-rings; then
    every colliding-rings verdict rebound_ratio,rebound_ratio% least_diameter,least_diameter%
    table enog oenog tl pfj-jst
  fi
  if section oscillating-plate "Ten rows of particles; then, with \`vf=0.001\`, five, ten and twenty rows."; then
    column 'period, `vf=0.001`' period,period% oscillating-plate --set vf=0.001
    every oscillating-plate period,period% first_peak,first_peak%
    table enog oenog tl pfj-jst
    for dp in 0.004 0.002 0.001; do
      column "period, first peak at $dp m" period%,first_peak% oscillating-plate --set vf=0.001 --spacing $dp
    done
    table oenog
  fi
  if section ball-plate; then
    every ball-plate verdict deflection,deflection% rebound_ratio,rebound_ratio%
    table enog oenog tl pfj-jst
  fi
  if section ringing-ring "Error of the period by spacing."; then
    for dp in 0.0025 0.002 0.001 0.0005; do column "$dp m" period% ringing-ring --spacing $dp; done
    table oenog tl
  fi
  if section kernel "\`oscillating-plate\`: error of the period, by amplitude and rows of particles."; then
    for vf in 0.001 0.05; do
      for rows in 5 10; do column "\`vf=$vf\`, $rows" period% oscillating-plate --set vf=$vf --spacing H/$rows; done
    done
    local settings=()
    for zeta in 3.5 4; do
      settings+=("enog --set method.zeta=$zeta" "enog --set method.zeta=$zeta --set method.cubic_spline=1")
    done
    table "${settings[@]}"
  fi
  if section beam-bending "\`--set force=F\`: deflection, by F in N/m."; then
    for force in 25 50 75 100 150 250; do column $force deflection_y,deflection_y% beam-bending --set force=$force; done
    table icb 'ccbwat --spacing 0.002 --until 0.4'
  fi
  if section truss "\`--set force=F\`: extension, by F in N/m."; then
    for force in 1000 3000 5000 7000 -3000 -7000; do column $force extension,extension% truss --set force=$force; done
    table icb ccbwat
  fi
  if section annulus-drop; then
    for shape in ring square; do
      for mode in 1 2 3; do every annulus-drop ${shape}_frequency_$mode,${shape}_frequency_$mode%; done
    done
    table oenog
  fi
  if section bending-column "\`poisson_ratio=0.499\`, 3 × 18 and 5 × 30 particles: alternating pressure."; then
    column '3 × 18' alternating bending-column --set poisson_ratio=0.499
    column '5 × 30' alternating bending-column --set poisson_ratio=0.499 --spacing 0.2
    table pf-jst pfj-jst
  fi
  if section square-cantilever "Error of the periods of bending and torsion (\`--set torsion=1\`), by particles across."; then
    across() {
      local n
      for n; do
        column "bending, $n" period% square-cantilever --spacing side/$n
        column "torsion, $n" period% square-cantilever --spacing side/$n --set torsion=1
      done
    }
    across 3 5 8 10
    table 'oenog --set method.damping=0'
    across 3 5
    table tl enog
  fi
  if section oscillating-plate-3d "Error of the period, by mode (M, N): \`--set m=M --set n=N\`."; then
    for mode in '1 1' '2 1' '2 2'; do
      column "(${mode/ /, })" period% oscillating-plate-3d --set m=${mode% *} --set n=${mode#* }
    done
    table oenog
  fi
  if section cable-3d; then
    every cable-3d end_rmse overshoot stress_error
    table tl pf pf-jst pfj-jst 'pf-jst --set method.eps_v2=1/32' 'pf-jst --set method.eps_v2=1/8' oenog enog
  fi
  if section spinning-cube "6³ particles and 0.2 s, 10³ and 0.05 s, 10³ and 0.2 s, 20³ and 0.2 s."; then
    every spinning-cube verdict alternating
    column '`corner_error`, 10³, 0.05 s' corner_error spinning-cube --spacing 1/9 --until 0.05
    column '10³, 0.2 s' corner_error spinning-cube --spacing 1/9
    column '20³, 0.2 s' corner_error spinning-cube --spacing 1/19
    table tl pf-jst pfj-jst oenog enog
  fi
  if section tensile-cube; then
    every tensile-cube verdict zigzag alternating top_580us,top_580us% top_1700us,top_1700us% top_2100us,top_2100us%
    table tl pf pf-jst oenog enog 'pf-jst --spacing 0.0714285714 --set method.eps_v4=1'
  fi
  if section coining; then
    every coining verdict zigzag alternating bulge,bulge% highest_point,highest_point% side_rmse volume_change
    table tl pf pf-jst pfj-jst oenog enog
  fi
  if section punch; then
    every punch verdict zigzag alternating volume_change edge_rmse
    table tl pf pf-jst 'pfj-jst --set method.eps_J4=1/8' oenog
  fi
  if section punch-cube; then
    every punch-cube verdict zigzag alternating alternating_last
    table tl pf pf-jst pfj-jst oenog
  fi
  if section bending-column-3d; then
    every bending-column-3d verdict peak_time% top_x_1500ms,top_x_1500ms% top_y_1500ms,top_y_1500ms%
    table tl pf-jst pfj-jst oenog
  fi
  if section twisting-column "\`twist_100ms\` and \`twist_250ms\`, by particles across."; then
    for spacing in 1/3 1/4 1/5 1/6; do
      column "$((${spacing#*/} + 1)) across" twist_100ms%,twist_250ms% twisting-column --spacing $spacing --until 0.26
    done
    table pf-jst pfj-jst oenog tl
  fi
}

pages >"$runs/page"
grep -q '^|' "$runs/page" || { echo "$0: no section is named ${sections[*]}; its script lists them" >&2; exit 2; }
mkdir -p "$(dirname "$to")"
mv "$runs/page" "$to"
echo "$to"
