#!/bin/sh
# A test of numbers in somebody's CI: are period, amplitude and verdict of a scene still what they were?
#
#     scenes/studies/numbers-in-ci.sh [OPTION OF taut run ...]
#
# Exit code 0: as expected; 1: a number has moved, and the table says which and by how much; 2 or more: the scene or
# the command is wrong. taut is found as build/taut, or where TAUT says. In GitHub Actions, for example:
#
#     - run: scenes/studies/numbers-in-ci.sh
#
# What is right stands here. It may also be a run that was looked at: keep its run.json in the repository and write
#
#     taut check out/numbers --baseline baselines/plate.json --tolerance 1%
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}

# Few particles, no pictures: a second. Tolerances cover another compiler or processor, and little else.
"$taut" run oscillating-plate --method oenog --spacing 0.005 --until 0.28 --no-render --quiet --out out/numbers "$@"
exec "$taut" check out/numbers --verdict stable \
  --measure 'period=0.25356±0.1%' \
  --measure 'first_peak=0.1065±0.1%' \
  --measure 'conservation.energy<0.01'
