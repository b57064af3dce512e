harm="each signal at each stage of each kind of work: the promised exit code, and no temporary files after an orderly stop"

# name | preparation | condition for the signal | command
stages=(
  "stepping|nothing|rows out/history.csv 5|run $scene --set speed=1 --until 100 --quiet --frames 100000 --out out"
  "stepping, with checkpoints|nothing|test -e out/checkpoint.bin|run $scene --until 100 --quiet --checkpoint-every 0.001 --out out"
  "stepping between far outputs|nothing|rows out/history.csv 1|run $scene --set cfl=1e-5 --until 100 --quiet --no-render --out out"
  "drawing kept frames|nothing|test -e out/frames/frame_00002.png|run $scene --frames 1500 --range auto --quiet --out out"
  "drawing again|a_run|test -e out/frames/frame_00001.png|render out --size 4000x3000 --quiet --threads 1"
  "sweep|nothing|rows out/speed=1/history.csv 5|sweep $scene --grid speed=1,2,3,4 --until 100 --quiet --out out"
  "session|nothing|test -e now.png|session $scene"
  "bisecting|nothing|nap 300|critical-step $scene --method pfj-jst --spacing 0.0005"
  "snapshot|nothing|rows out/history.csv 5|snapshot $scene --until 100 --quiet --baseline base --update --out out"
  "panel|nothing|nap 200|compare $ground/run --size 5000x4000 --out panel.png"
  "movie|nothing|test -e movie.mp4.part/movie.mp4|movie $ground/many --out movie.mp4"
)
signals=(INT TERM HUP "INT INT" "TERM TERM" KILL QUIT USR1)

nothing() { :; }
a_run() { cp -a "$ground/run" out; rm out/frames/*; }
rows() { (($(wc -l <"$1") >= $2)); }

prepare() {
  local k
  ends 0 run "$scene" --quiet --save-particles --out run
  mkdir many
  for ((k = 0; k < 2000; ++k)); do ln -s "../run/frames/frame_0000$((k % 10)).png" "many/$(printf frame_%05d.png "$k")"; done
  printf 'step\nframe now.png\nrun until 100\nsave state\n' >script
}

trial() {
  local stage before until command signal promised
  IFS='|' read -r stage before until command <<<"${stages[(number - 1) % ${#stages[@]}]}"
  signal=${signals[((number - 1) / ${#stages[@]}) % ${#signals[@]}]}
  $before
  input=$ground/script
  start $command
  await $until || { finish "taut $command"; wrong "'$stage' ended with $code before the signal: $(complaint)"; return; }
  strike "$signal"
  finish "taut $command (SIG$signal)"
  promised=$(by_signal "${signal% *}")
  [[ $code == "$promised" ]] || wrong "$stage: exit code $code, not $promised, after SIG$signal: $(complaint)"
  # two signals, and signals without a handler, end the program at once; a panel has nothing to clean up
  is_one_of "$signal" "INT TERM HUP" && [[ $stage != panel ]] || return 0
  no_rests .
  if [[ -e out/history.csv && $before == nothing ]]; then
    [[ $(status out) == interrupted ]] || wrong "$stage: run.json has status '$(status out)' after SIG$signal"
  fi
}
