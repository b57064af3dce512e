#!/bin/sh
# A sweep that finds the highest speed at which colliding rubber rings remain stable.
#
#     scenes/studies/rings-sweep.sh [FOLDER [SPACING]]
#
# FOLDER receives runs and results (default: out/rings-sweep); SPACING is the particle spacing in m (default: 0.002;
# as published: 0.001). Uses build/taut, or the program in TAUT. Can be stopped and resumed; finished runs are not
# repeated.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
folder=${1:-out/rings-sweep}
spacing=${2:-0.002}

# 1. List the runs. The grid is in rings-speed-limit.toml beside this script; on the command line it would be
#    taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog
"$taut" sweep rings-speed-limit --spacing "$spacing" --out "$folder" --list

# 2. Run on all cores. A run that fractures or diverges is an ordinary row, so the exit code is 0.
"$taut" sweep rings-speed-limit --spacing "$spacing" --out "$folder"

# 3. Derive the answer from results.csv by column names.
echo
echo "Highest speed up to which the verdict is stable, by method, in c0:"
awk -F, '
  NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
  {
    method = $column["set.method"]; speed = $column["set.v0"]
    if (!(method in limit)) limit[method] = "none"
    if ($column["verdict"] != "stable") torn[method] = 1
    if (!torn[method]) limit[method] = speed      # rows are ordered by rising speed
  }
  END { for (method in limit) print "  " method, limit[method] }' "$folder/results.csv" | sort
