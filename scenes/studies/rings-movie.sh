#!/bin/sh
# Image sequences of two colliding rubber rings with `og`, which fractures, and `enog`, and movies of `enog`.
#
#     scenes/studies/rings-movie.sh [FOLDER [SPACING [FRAMES]]]
#
# FOLDER receives all files (default: out/rings-movie). SPACING is the particle spacing in m (default: 0.001, as
# published), FRAMES the number of frames (default: 60). Uses build/taut, or the program in TAUT.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
folder=${1:-out/rings-movie}
spacing=${2:-0.001}
frames=${3:-60}

# 1. Two runs with frames in FOLDER/METHOD/frames. Saved particles can be drawn again in other ways.
for method in og enog; do
  "$taut" run colliding-rings --method $method --spacing "$spacing" --frames "$frames" --size 960x540 \
    --save-particles --fields von_mises,pressure --out "$folder/$method"
done

# 2. Another view of one run without a new simulation
"$taut" render "$folder/enog" --color pressure --range -2e6:2e6 --view -0.03:0.03:-0.02:0.02 --size 960x640 \
  --out "$folder/close"

# 3. Both runs side by side: a column for each run, a row for each time.
"$taut" compare "$folder/og" "$folder/enog" --times 0.002,0.005,0.008,0.012 --out "$folder/panel.png"

# 4. Movies: mp4 for talks, gif for web pages
"$taut" movie "$folder/enog" --fps 20 --out "$folder/rings.mp4"
"$taut" movie "$folder/close" --fps 20 --out "$folder/close.gif"
