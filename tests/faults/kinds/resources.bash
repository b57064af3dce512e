harm="too few open files or processes, too little memory or stack: an error with a message, or success"

works=(
  "run $scene --until 0.01 --quiet --save-particles --out out" "run $scene --until 0.01 --threads 8 --quiet --no-render --out out"
  "sweep $scene --grid speed=0.4,0.8 --until 0.002 --quiet --out sweep" "render $ground/out --quiet --out drawn"
  "compare $ground/out --size 3000x3000 --out panel.png" "movie $ground/out --out movie.gif" "chart $ground/sweep --out chart.svg"
  "diff $ground/out $ground/out" "session $scene --strict" "check $ground/out --verdict stable" "list scenes"
  "critical-step $scene" "snapshot $scene --until 0.01 --baseline base --update --quiet --out x"
)

prepare() {
  ends 0 run "$scene" --until 0.01 --quiet --save-particles --out out
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --until 0.002 --quiet --out sweep
  printf 'run until 0.002\nframe now.png\nsave state\n' >script
}

# runs a command with one resource limit, in a subshell, because `ulimit` cannot be undone
trial() {
  local work=${works[(number - 1) % ${#works[@]}]} option value
  choose n v v v u s; option=$chosen
  case $option in
    n) pick 14; value=$((3 + picked)) ;;               # files
    v) pick 100; value=$((6000 * picked + 30000)) ;;   # KiB of address space
    u) pick 3; value=$((1 + picked)) ;;                # processes and threads; no limit for root
    s) pick 4; value=$((64 << picked)) ;;              # KiB of stack
  esac
  input=$ground/script
  (
    ulimit -S -c 0
    limit "$option" "$value" "$program" $work >said 2>complained <"$input"
  )
  code=$?
  harmed
  sound "taut $work, ulimit -$option $value"
  is_one_of "$code" "124 137" && { hung "no end after $patience s: taut $work, ulimit -$option $value"; return; }
  # 127: the system could not load the program
  is_one_of "$code" "0 2 4 127" || wrong "exit code $code: taut $work, ulimit -$option $value: $(complaint)"
  [[ $code == 0 || -s complained || -s said ]] || wrong "exit code $code without a message: taut $work, ulimit -$option $value"
  if [[ $code == 0 && -e out/run.json ]]; then [[ $work != *save-particles* ]] || same_run "$ground/out" out; fi
  [[ ! -d out/frames ]] || part_of_run out "$ground/out"
}

# limit OPTION VALUE COMMAND...: limits only the command, not `timeout`
limit() { timeout --kill-after 1 "$patience" bash -c 'ulimit -S "-$0" "$1" && exec "${@:2}"' "$@"; }
