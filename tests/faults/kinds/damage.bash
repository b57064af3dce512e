harm="a file of a run, sweep or session is truncated, changed, removed or replaced: commands refuse it or continue"

# damaged files | exit codes | the command that reads them
readers=(
  "run/run.json|0 1 2|check run --verdict stable"
  "run/run.json|0 1 2|check run --baseline good.json --tolerance 1%"
  "good.json|0 1 2|check run --baseline good.json --tolerance 1%"
  "run/run.json run/history.csv|0 2|plot run --out plot.svg"
  "run/run.json run/scene.toml run/frames/*|0 2|run run/scene.toml --until 1e-4 --quiet --out run"
  "run/scene.toml|0 2 3|run run/scene.toml --until 1e-4 --quiet --out again"
  "run/scene.toml|0 2|describe run/scene.toml"
  "run/scene.toml run/particles/*|0 2|render run --quiet --size 64x64 --out drawn"
  "run/scene.toml run/particles/*|0 2 4|render run --quiet --size 64x64 --color pressure --range auto --style cells"
  "run/scene.toml run/particles/*|0 2|compare run --size 640x480 --out panel.png"
  "run/run.json run/frames/*|0 2 4|movie run --out movie.gif"
  "run/frames/*|0 1 2|diff run good-frames --out diff.png"
  "run/frames/*|0 1 2|diff run/frames/frame_00000.png good-frames/frame_00000.png"
  "stopped/*|0 2 3 4|run --resume stopped --quiet"
  "sweep/results.csv sweep/results.json|0 2|chart sweep --json"
  "sweep/results.csv sweep/results.json|0 2|map sweep --out map.svg"
  "sweep/results.csv sweep/results.json|0 1 2|choose $scene --set until=0.002 --from sweep"
  "sweep/* sweep/*/*|0 2 4|sweep $scene --grid speed=0.4,0.8 --until 0.002 --quiet --out sweep"
  "sweep/* sweep/*/*|0 2|sweep $scene --grid speed=0.4,0.8 --until 0.002 --list --out sweep"
  "sweep/*/run.json|0 2|sweep $scene --grid speed=0.4,0.8 --until 0.002 --index 0 --quiet --out sweep"
  "baseline/*|0 1 2|snapshot $scene --until 0.002 --quiet --out x --baseline baseline"
  "baseline/*|0 2|snapshot $scene --until 0.002 --quiet --out x --baseline baseline --update"
  "state|0 2|session $scene --strict"
)

prepare() {
  mkdir all && cd all || exit 2
  ends 0 run "$scene" --until 0.01 --frames 2 --history 1e-3 --quiet --save-particles --out run
  cp -a run/frames good-frames && cp run/run.json good.json
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --until 0.002 --quiet --out sweep
  ends 0 snapshot "$scene" --until 0.002 --quiet --out x --baseline baseline --update
  start run "$scene" --history 1e-3 --checkpoint-every 0.002 --quiet --save-particles --fields speed --out stopped
  await test -e stopped/particles/particles_00002.vtp
  kill -KILL "$victim"
  finish "taut run"
  printf 'run until 0.002\nsave state\n' >script
  printf 'load state\nrun until 0.003\nframe now.png\n' >load
  input=script
  ends 0 session "$scene" --strict
  input=load
  cd ..
  local reader
  for reader in "${readers[@]}"; do
    mkdir sound && cp -a all/. sound && cd sound || exit 2
    ends 0 ${reader##*|}
    cd .. && rm -r sound
  done
}

# sets $reader and $promised to a random command and its exit codes, and $file to one of its files
choose_file() {
  local files
  pick ${#readers[@]}
  IFS='|' read -r files promised reader <<<"${readers[picked]}"
  files=$(find $files -type f | sort)
  choose $files
  file=$chosen
}

byte_at_random() { pick "$(($(stat -c %s "$file") + 1))"; at=$picked; }
# overwrite AT BYTES (in printf format)
overwrite() { printf "$2" | dd of="$file" bs=1 seek="$1" conv=notrunc status=none; }

cut_short() { byte_at_random; truncate -s "$at" "$file"; }
flip_bits() {
  local k old bit
  for ((k = 0; k < $1; ++k)); do
    pick "$(stat -c %s "$file")"; at=$picked
    old=$(od -An -tu1 -j "$at" -N 1 "$file")
    pick 8; bit=$((1 << picked))
    overwrite "$at" "\\x$(printf %02x $((old ^ bit)))"
  done
}
zeroes() { byte_at_random; pick 64; overwrite "$at" "$(printf '\\x00%.0s' $(seq $((picked + 1))))"; }
twice() { cat "$file" >>"$file.2" && cat "$file" >>"$file.2" && mv "$file.2" "$file"; }
digits() {  # replaces a number by an extreme or invalid one
  choose 0 -1 9999999999 1e308 -1e-320 nan inf 4294967296 '"' '{' '' null; local value=$chosen
  pick "$(grep -cE '[0-9]' "$file")"
  sed -i -E "$((picked + 1))s/[0-9][0-9.e+-]*/$value/" "$file"
}
lines_mixed() { shuf --random-source=<(yes "$RANDOM") "$file" -o "$file"; }
empty() { : >"$file"; }
gone() { rm "$file"; }
a_folder() { rm "$file" && mkdir "$file"; }
a_dead_link() { ln -sf nowhere "$file"; }
a_loop() { ln -sf "$(basename "$file")" "$file"; }
endless() { ln -sf /dev/zero "$file"; }
other_file() { cp "$ground/all/run/frames/frame_00000.png" "$file"; }

trial() {
  local file reader promised damage before
  cp -a "$ground/all/." .
  choose_file
  choose cut_short cut_short cut_short "flip_bits 1" "flip_bits 1" "flip_bits 1" "flip_bits 20" zeroes twice digits digits \
    digits lines_mixed empty gone a_folder a_dead_link a_loop endless other_file
  damage=$chosen
  before=$(wc -l <"$findings")
  [[ -s $file ]] && $damage 2>/dev/null
  harmed
  input=load
  ends "$promised" $reader
  if [[ $code == 2 && ! -s complained ]] && ! grep -q '^error: ' said; then wrong "no message: taut $reader"; fi
  [[ $(wc -l <"$findings") == "$before" ]] || sed -i "\$s|\$| ($damage of $file)|" "$findings"
}
