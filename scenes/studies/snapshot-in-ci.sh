#!/bin/sh
# A snapshot test for CI: compares the pictures of a scene with a baseline.
#
#     scenes/studies/snapshot-in-ci.sh [BASELINE [OPTION OF taut run ...]]
#
# The first call creates the folder BASELINE (default: baselines/colliding-rings): inspect its pictures and commit
# them (about 20 kB each). Later calls run the scene and compare. Exit code 0: alike; 1: different, the last lines
# name the picture of the difference; 2 or more: nothing was compared. Uses build/taut, or the program in TAUT.
# In GitHub Actions, for example:
#
#     - run: scenes/studies/snapshot-in-ci.sh baselines/colliding-rings
#     - uses: actions/upload-artifact@v4
#       if: failure()
#       with: { path: out/ }
#
# Pictures are compared visually, not byte by byte. After an intended change, renew the baseline with --update.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
baseline=${1:-baselines/colliding-rings}

[ $# -eq 0 ] || shift
# few particles and small frames, during contact; for your own scene, write its path
set -- colliding-rings --baseline "$baseline" --spacing 0.002 --until 0.006 --frames 4 --size 320x180 "$@"

if [ ! -d "$baseline" ]; then
  "$taut" snapshot "$@" --update
  echo "That was the first call: look at $baseline, and commit it if it is right."
  exit 0
fi
exec "$taut" snapshot "$@"
