harm="movie, chart, map, plot, compare, diff, render and snapshot --update are interrupted: the file is the old or the new one"

# file | exit code | command that makes the old version | command that is interrupted
works=(
  "movie.mp4|0|movie $ground/run --fps 10 --out|movie $ground/other --out"
  "movie.gif|0|movie $ground/run --fps 10 --out|movie $ground/other --out"
  "chart.png|0|chart $ground/sweep --cost steps --methods enog --out|chart $ground/sweep --cost steps --out"
  "map.svg|0|map $ground/small --out|map $ground/sweep --out"
  "plot.png|0|plot $ground/run --out|plot $ground/run $ground/other --out"
  "panel.png|0|compare $ground/run --out|compare $ground/run $ground/other --out"
  "diff.png|1|diff $ground/run $ground/other --out|diff $ground/other $ground/run --out"
  "drawn|0|render $ground/run --color pressure --quiet --out|render $ground/other --quiet --out"
  "baseline|0|snapshot $scene --until 0.01 --out x --update --quiet --baseline|snapshot $scene --until 0.01 --set speed=1 --out x --update --quiet --baseline"
)

prepare() {
  ends 0 run "$scene" --quiet --save-particles --out run
  ends 0 run "$scene" --set speed=1 --quiet --save-particles --out other
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --grid method=enog,oas --until 0.01 --quiet --out sweep
  ends 0 sweep "$scene" --grid speed=0.4,0.6 --grid method=enog,oas --until 0.01 --quiet --out small
}

# makes both versions once, $ground/NAME-old and -new; $took is the duration of the second command, in ms
make_states() {
  local states=$ground/$name
  if [[ ! -e $states.took ]]; then
    mkdir "$states-old" "$states-new"
    cd "$states-old" && ends "$promised" $before "$name"
    cd "$states-new" && how_long $after "$name"
    echo "$took" >"$states.took"
    cd "$here" || exit 2
  fi
  took=$(<"$states.took")
}

# lists the file, its gnuplot script and its data
pieces() { (cd "$ground/$name-new" && ls -d "$name" "${name%.*}.gp" "${name%.*}.dat" 2>/dev/null); }

# checks the state of all files; render writes single frames, each complete
look() {
  local piece file
  for piece in $(pieces); do
    if [[ $name == drawn ]]; then
      for file in drawn/*.png; do [[ ! -e $file ]] || old_or_new "$file" "$ground/drawn-old/$file" "$ground/drawn-new/$file"; done
    else
      old_or_new "$piece" "${was:+$was/$piece}" "$ground/$name-new/$piece"
    fi
  done
}

trial() {
  local name promised before after piece was=
  IFS='|' read -r name promised before after <<<"${works[(number - 1) % ${#works[@]}]}"
  make_states
  pick 3
  if ((picked)); then
    was=$ground/$name-old
    for piece in $(pieces); do cp -a "$was/$piece" .; done
  fi
  choose KILL KILL TERM INT HUP; local signals=$chosen
  strike_at_random "$signals" "$took" $after "$name"
  ((!struck)) || [[ $code == "$promised" ]] || stopped_by "$signals"
  look
  [[ $signals == KILL ]] || no_rests .
  ends "$promised" $after "$name"
  was=$ground/$name-new
  look
}
