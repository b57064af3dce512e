#!/bin/sh
# A snapshot test in somebody's CI: do the pictures of a scene still look as they did?
#
#     scenes/studies/snapshot-in-ci.sh [BASELINE]
#
# The first call makes the folder BASELINE (default: baselines/colliding-rings): look at its pictures and commit them
# (some 20 kB each). Every later call runs the scene again and compares. Exit code 0: alike; 1: they differ, and the
# last lines say where a picture of the difference is; 2 or more: the scene or the command is wrong. taut is found as
# build/taut, or where TAUT says. In GitHub Actions, for example:
#
#     - run: scenes/studies/snapshot-in-ci.sh baselines/colliding-rings
#     - uses: actions/upload-artifact@v4
#       if: failure()
#       with: { path: out/ }
#
# Pictures are compared as seen, not byte by byte: another compiler or processor does not matter, another colour map
# or a particle that has gone astray does. When a change is meant, make the baseline anew with --update.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
baseline=${1:-baselines/colliding-rings}

# A test should be quick and say much: few particles, a handful of small frames, a time at which something happens.
# A scene of your own stands here as a path, my-scene.toml. More options of `taut run` may follow BASELINE.
[ $# -eq 0 ] || shift
set -- colliding-rings --baseline "$baseline" --spacing 0.002 --until 0.006 --frames 4 --size 320x180 "$@"

if [ ! -d "$baseline" ]; then
  "$taut" snapshot "$@" --update
  echo "That was the first call: look at $baseline, and commit it if it is right."
  exit 0
fi
exec "$taut" snapshot "$@"
