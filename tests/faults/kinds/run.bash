harm="a run with checkpoints is interrupted up to five times and resumed: its files equal those of an undisturbed run"

methods=(enog og oenog d-ulsph-r-tic tl pfj-jst ulsph-av-as ccb oas)
options=(--quiet --save-particles --fields pressure,speed)

prepare() { :; }

# undisturbed METHOD RANGE: sets $straight to the run's folder, $took to its duration in ms
undisturbed() {
  straight=$ground/$1-$2
  if [[ ! -e $straight ]]; then
    how_long run "$scene" --method "$1" --range "$2" --threads 1 "${options[@]}" --out "$straight"
    echo "$took" >"$straight.took"
  fi
  took=$(<"$straight.took")
}

older_run() {
  [[ -e $ground/older ]] ||
    ends 0 run "$scene" --set speed=0.9 --until 0.02 --no-render --quiet --save-particles --out "$ground/older"
  cp -a "$ground/older" out
}

has_ended() { [[ ! -e out/checkpoint.bin && $(status out) == finished ]] && cmp -s out/scene.toml "$straight/scene.toml"; }
untouched() { [[ $(sums out 2>/dev/null) == "$before" ]]; }

trial() {
  local round every threads range signals
  choose 0:1 0:1 auto; range=$chosen  # a fixed range draws frames during the run, auto at its end
  frames_are="cmp -s"
  [[ $range != auto ]] || frames_are=whole_png
  undisturbed "${methods[(number - 1) % ${#methods[@]}]}" "$range"
  choose 0.0003 0.001 0.005 0.03; every=$chosen  # simulated time between checkpoints, s
  choose 1 2; threads=$chosen
  pick 3; ((picked)) || older_run
  local again=(run "$scene" --method "${methods[(number - 1) % ${#methods[@]}]}" --range "$range" --threads "$threads"
               "${options[@]}" --checkpoint-every "$every" --out out)
  for round in 1 2 3 4 5; do
    before=$(sums out 2>/dev/null)
    choose KILL KILL KILL KILL TERM HUP INT "INT INT" "TERM INT"; signals=$chosen
    strike_at_random "$signals" "$took" "${again[@]}"
    stopped_by "$signals"
    [[ ! -d out ]] || part_of_run out "$straight" "$ground/older"
    has_ended && break
    # a signal can come before its handler is installed
    if is_one_of "$signals" "TERM HUP INT" && ((code > 128)) && [[ $(status out) != interrupted ]] && ! untouched; then
      wrong "run.json has status '$(status out)' after SIG$signals"
    fi
    [[ ! -e out/checkpoint.bin ]] || again=(run --resume out --threads "$threads" --quiet)
  done
  has_ended || ends 0 "${again[@]}"
  same_run "$straight" out
}
