#!/usr/bin/env bash
# Compares both forms of the biharmonic dissipation of [Lee2016]: the adjoint (`method.adjoint=1`, the default) and the
# printed one (0), on its punch, twisting column and bending column.
#
#     scenes/studies/lee-adjoint.sh [FILE]     # into results/lee-adjoint.md; half a minute
#
# Uses build/taut, or the program in TAUT.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
to=$(realpath -m "${1:-$here/results/lee-adjoint.md}")
runs=$(mktemp -d) count=0
trap 'rm -rf "$runs"' EXIT

# row MEASURES SCENE METHOD [options of taut run]: a line of the table for each form
row() {
  measures=$1
  shift
  for adjoint in 1 0; do
    echo "$* --set method.adjoint=$adjoint" >&2
    "$taut" run "$1" --method "${@:2}" --set "method.adjoint=$adjoint" --no-render --quiet --threads 1 \
      --out "$runs/$((++count))" >/dev/null || [[ $? == 3 ]]   # 3: diverged, a row as well
    awk -v measures="$measures" -v command="$*" -v adjoint="$adjoint" '
      { key = $1; gsub(/[":]/, "", key); text = $2; gsub(/[",]/, "", text) }
      /^  "verdict"/ { verdict = text }
      /^    "[^"]*": \{/ { inside = key }
      /^      "/ { of[inside, key] = text }
      END {
        printf "| `%s` | %d | `%s` | %.0f | %.3f |", command, adjoint, verdict,
          100 * of["pressure_checkerboard", "greatest"], of["hourglass_error", "greatest"]
        for (n = split(measures, name, ","); ++k <= n;) {
          value = of[name[k], "value"]; reference = of[name[k], "reference"]
          shown = sprintf("%+.1f %%", 100 * (value - reference) / (reference < 0 ? -reference : reference + 1e-99))
          if (name[k] ~ /rmse$/) shown = sprintf("%.1f mm", 1000 * value)
          if (value == "null") shown = "-"
          printf "%s `%s` %s", (k > 1 ? "," : ""), name[k], shown
        }
        print " |"
      }' "$runs/$count/run.json"
  done
}

{
  echo "# Both forms of the dissipation of Lee2016"
  echo
  echo "Made by \`lee-adjoint.sh\`; do not edit. \`method.adjoint\` is 1 for the adjoint L\\*[L[U]], the default, and 0 for the"
  echo "printed L[L[U]]. Alternating: greatest part of the pressure that alternates between particles; zigzag: greatest"
  echo "\`hourglass_error\`. Percentages are differences from the references, positive if the value is greater."
  echo "The reference of \`twist_250ms\` is negative: there, positive means too small a twist."
  echo
  echo "| scene, method, settings | adjoint | verdict | alternating, % | zigzag | measures |"
  echo "|---|---|---|---|---|---|"
  row edge_rmse,highest_rmse punch pf-jst
  row edge_rmse,highest_rmse punch pfj-jst --set method.eps_J4=1/8
  row peak_time,top_x_rmse,top_y_rmse bending-column-3d pf-jst
  row peak_time,top_x_rmse,top_y_rmse bending-column-3d pfj-jst
  for spacing in 1/3 1/4 1/5 1/6; do
    row twist_100ms,twist_250ms twisting-column pf-jst --spacing $spacing --until 0.26
  done
} >"$runs/page"
mkdir -p "$(dirname "$to")"
mv "$runs/page" "$to"
echo "$to"
