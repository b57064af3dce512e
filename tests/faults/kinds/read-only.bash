harm="read-only folders: reading works, writing ends with exit code 4 and names the path, and nothing changes"

# with `all` read-only and `here` writable: exit code | path that the message must contain | command
works=(
  "0||check all/run --verdict stable"
  "0||plot all/run --out here/plot.svg"
  "0||render all/run --quiet --out here/drawn"
  "0||compare all/run --out here/panel.png"
  "0||movie all/run --out here/movie.gif"
  "0||diff all/run all/run"
  "0||chart all/sweep --json"
  "0||choose $scene --set until=0.002 --from all/sweep"
  "0||sweep $scene --grid speed=0.4,0.8 --until 0.002 --quiet --list --out all/sweep"
  "0||describe all/run/scene.toml"
  "0||snapshot $scene --until 0.002 --quiet --out here/x --baseline all/baseline"
  "4|all/run|run $scene --quiet --out all/run"
  "4|all/new|run $scene --quiet --out all/new"
  "4|all/stopped|run --resume all/stopped --quiet"
  "4|all/run|render all/run --quiet"
  "4|all/drawn|render all/run --quiet --out all/drawn"
  "4|all/run|render all/run --quiet --out all/run/frames"
  "4|all/panel.png|compare all/run --out all/panel.png"
  "4|all/movie.gif|movie all/run --out all/movie.gif"
  "4|all/diff.png|diff all/run/frames/frame_00000.png all/run/frames/frame_00001.png --out all/diff.png"
  "4|all/junit.xml|check all/run --verdict stable --junit all/junit.xml"
  "4|all/plot|plot all/run --out all/plot.svg"
  "4|all/chart|chart all/sweep --out all/chart.png"
  "4|all/sweep|sweep $scene --grid speed=0.4,1.2 --until 0.002 --quiet --out all/sweep"
  "4|all/sweep|sweep $scene --grid speed=0.4,0.8 --until 0.002 --index 0 --force --quiet --out all/sweep"
  "4|all/sweep|sweep $scene --grid speed=0.4,0.8 --until 0.002 --emit slurm --out all/sweep"
  "4|all/baseline|snapshot $scene --until 0.002 --quiet --out here/x --baseline all/baseline --update"
  "4|all/other|snapshot $scene --until 0.002 --quiet --out here/x --baseline all/other --update"
  "4|all/state|session $scene --strict"
)

prepare() {
  mkdir all
  ends 0 run "$scene" --until 0.01 --frames 2 --quiet --save-particles --out all/run
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --until 0.002 --quiet --out all/sweep
  ends 0 snapshot "$scene" --until 0.002 --quiet --out x --baseline all/baseline --update
  start run "$scene" --checkpoint-every 0.002 --quiet --out all/stopped
  await test -e all/stopped/frames/frame_00002.png
  kill -KILL "$victim"
  finish "taut run"
  printf 'run until 0.001\nsave all/state\n' >script
}

# Without mounts, permissions forbid writing, but not for root.
forbid() { read_only all || { ((EUID)) && chmod -R a-w all; }; }
allow() { if mountpoint -q all; then umount all; else chmod -R u+w all; fi; }

trial() {
  local promised place command before
  cp -a "$ground/all" .
  mkdir here
  forbid || { ((number > 1)) || echo "read-only: skipped, since mounting is not permitted and root can write everywhere" >&2; return; }
  IFS='|' read -r promised place command <<<"${works[(number - 1) % ${#works[@]}]}"
  before=$(sums all)
  input=$ground/script
  harmed
  ends "$promised" $command
  [[ -z $place ]] || grep -qF -- "$place" complained said || wrong "does not name $place: $(complaint)"
  [[ $(sums all) == "$before" ]] || lost "a read-only folder has changed"
  allow
}
