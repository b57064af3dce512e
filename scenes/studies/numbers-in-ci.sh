#!/bin/sh
# A regression test for CI: checks period, amplitude, energy and verdict of a scene.
#
#     scenes/studies/numbers-in-ci.sh [OPTION OF taut run ...]
#
# Exit code 0: as expected; 1: a check failed, see the table; 2 or more: nothing was checked. Uses build/taut, or the
# program in TAUT. In GitHub Actions, for example:
#
#     - run: scenes/studies/numbers-in-ci.sh
#
# A reviewed run can replace the expected values below: keep its run.json in the repository and write
#
#     taut check out/numbers --baseline baselines/plate.json --tolerance 1%
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}

# The tolerances cover other compilers and processors.
"$taut" run oscillating-plate --method oenog --spacing 0.005 --until 0.28 --no-render --quiet --out out/numbers "$@"
exec "$taut" check out/numbers --verdict stable \
  --measure 'period=0.25356±0.1%' \
  --measure 'first_peak=0.1065±0.1%' \
  --measure 'conservation.energy<0.01'
