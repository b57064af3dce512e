#!/bin/sh
# A sweep: how fast may two rubber rings collide before a method lets them tear?
#
#     scenes/studies/rings-sweep.sh [FOLDER [SPACING]]
#
# FOLDER takes runs and results (default: out/rings-sweep), SPACING is that of the particles in m (default: 0.002, a
# few seconds; 0.001 as published, under a minute). taut is found as build/taut, or where TAUT says. May be stopped
# (Ctrl-C, kill, power cut) and started again: what is done is not done twice.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
folder=${1:-out/rings-sweep}
spacing=${2:-0.002}

# 1. What would run. The grid stands in rings-speed-limit.toml beside this script; it could as well be given here:
#    taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog
"$taut" sweep rings-speed-limit --spacing "$spacing" --out "$folder" --list

# 2. Run it, on all cores. A run that tears or diverges is a row like any other, so the exit code is 0.
"$taut" sweep rings-speed-limit --spacing "$spacing" --out "$folder"

# 3. Read the answer off results.csv: columns have names (results.json has the same as a tree).
echo
echo "The greatest speed up to which a method keeps the rings whole, in c0:"
awk -F, '
  NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
  {
    method = $column["set.method"]; speed = $column["set.v0"]
    if (!(method in limit)) limit[method] = "none"
    if ($column["verdict"] != "stable") torn[method] = 1
    if (!torn[method]) limit[method] = speed      # the rows come with speeds rising
  }
  END { for (method in limit) print "  " method, limit[method] }' "$folder/results.csv" | sort
