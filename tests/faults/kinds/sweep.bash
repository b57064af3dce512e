harm="a sweep is interrupted or a child killed, and the sweep is restarted: results and runs equal those of an undisturbed sweep"

grid=(sweep "$scene" --grid speed=0.2,0.4,0.8 --grid method=enog,oenog --until 0.05 --jobs 2 --quiet --out out)

prepare() { how_long "${grid[@]}"; }

# results FOLDER: prints the columns of results.csv before the first that varies between repetitions
results() {
  local last
  last=$(head -n 1 "$1/results.csv" | tr ',' '\n' | grep -nE '^(seconds|particle_steps|machine|threads)' | head -n 1 | cut -d: -f1)
  cut -d, -f "1-$((${last:-1000} - 1))" "$1/results.csv"  # the columns are absent if no run has finished
}

child_of_victim() { read -r child _ <"/proc/$victim/task/$victim/children" && [[ $child ]]; }

strike_child() {
  start "${grid[@]}"
  pick "$((took / round))"  # each round has less left to do
  nap "$picked"
  struck=0
  if await child_of_victim && kill -KILL "$child" 2>/dev/null; then
    struck=1
    harmed
  fi
  finish "taut ${grid[*]} (a child killed)"
  # 0 if the kill came too late
  is_one_of "$code" "0 70" || wrong "exit code $code after a child was killed: $(complaint)"
}

# rows of finished runs in results.csv equal the rows of the undisturbed sweep
whole_results() {
  local row
  [[ -e out/results.csv ]] || return 0
  [[ -z $(tail -c 1 out/results.csv) ]] || torn "results.csv ends within a row"
  [[ $(results out | head -n 1) == "$(results "$ground/out" | head -n 1)" ]] || return 0
  while IFS= read -r row; do
    grep -qxF -- "$row" <(results "$ground/out") || torn "results.csv: $row"
  done < <(results out | tail -n +2 | grep ',finished,')
}

trial() {
  local round signals folder
  for round in 1 2 3; do
    choose child KILL KILL TERM INT HUP "INT INT"; signals=$chosen
    if [[ $signals == child ]]; then
      strike_child
    else
      strike_at_random "$signals" "$((took / round))" "${grid[@]}"
      stopped_by "$signals"
    fi
    whole_results
  done
  ends 0 "${grid[@]}"
  diff <(results "$ground/out") <(results out) >differs || lost "results.csv: $(head -n 3 differs | tr '\n' ' ')"
  for folder in "$ground"/out/*/; do same_run "${folder%/}" "out/$(basename "$folder")"; done
}
