#!/bin/sh
# An image sequence and a movie: two rubber rings in collision, with a method that tears and with one that does not.
#
#     scenes/studies/rings-movie.sh [FOLDER [SPACING [FRAMES]]]
#
# FOLDER takes everything (default: out/rings-movie). SPACING is that of the particles in m (default: 0.001, as
# published), FRAMES their number (default: 60); about 10 s. taut is found as build/taut, or where TAUT says.
set -eu
taut=${TAUT:-$(dirname "$0")/../../build/taut}
folder=${1:-out/rings-movie}
spacing=${2:-0.001}
frames=${3:-60}

# 1. Two runs: their frames in FOLDER/METHOD/frames, over one range and one view. Saved particles can be drawn
#    again in any other way; two fields are enough here.
for method in og enog; do
  "$taut" run colliding-rings --method $method --spacing "$spacing" --frames "$frames" --size 960x540 \
    --save-particles --fields von_mises,pressure --out "$folder/$method"
done

# 2. Another view of one run without simulating again: the place where the rings touch, in pressure.
"$taut" render "$folder/enog" --color pressure --range -2e6:2e6 --view -0.03:0.03:-0.02:0.02 --size 960x640 \
  --out "$folder/close"

# 3. Both runs side by side, as in a paper's figure: a column for each run, a row for each time.
"$taut" compare "$folder/og" "$folder/enog" --times 0.002,0.005,0.008,0.012 --out "$folder/panel.png"

# 4. Movies: mp4 for talks, gif for web pages. Without ffmpeg this says what to install, and all else is there.
"$taut" movie "$folder/enog" --fps 20 --out "$folder/rings.mp4"
"$taut" movie "$folder/close" --fps 20 --out "$folder/close.gif"
