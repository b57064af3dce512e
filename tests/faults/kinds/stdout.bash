harm="standard output is full or closed: exit code 4; unread: no crash; in all cases complete files"

works=(
  "list scenes" "list methods --json" "describe enog" "describe scene-file" "describe $scene" "completion bash" "--help"
  "run --help" "--version" "check $ground/out --verdict stable" "chart $ground/sweep --json" "chart $ground/sweep --markdown"
  "choose $scene --set until=0.002 --error 1000 --from $ground/sweep" "diff $ground/out $ground/out" "critical-step $scene --method tl"
  "sweep $scene --grid speed=0.4,0.8 --until 0.002 --list --out $ground/sweep" "plot $ground/out --out plot.svg"
  "map $ground/sweep --json" "diff $ground/out $ground/out --json" "check $ground/out --verdict stable --json --junit junit.xml"
  "run $scene --until 0.01 --quiet --save-particles --out out" "sweep $scene --grid speed=0.4,0.8 --until 0.002 --out sweep"
  "snapshot $scene --until 0.01 --baseline base --update --quiet --out x" "compare $ground/out --out panel.png"
  "render $ground/out --quiet --out drawn" "movie $ground/out --out movie.gif" "session $scene"
)
whereto=(full closed closed-both nobody)

prepare() {
  ends 0 run "$scene" --until 0.01 --quiet --save-particles --out out
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --until 0.002 --quiet --out sweep
  printf 'step\ninfo\n%.0s' {1..20} >script
}

# with_output WHERE ARGUMENT...: runs the command with this standard output; sets $code
with_output() {
  local run=(timeout --kill-after 1 "$patience" "$program" "${@:2}")
  code=0
  case $1 in
    full) "${run[@]}" >/dev/full 2>complained <"$input" || code=$? ;;
    closed) "${run[@]}" >&- 2>complained <"$input" || code=$? ;;
    closed-both) "${run[@]}" >&- 2>&- <&- || code=$? ;;
    nobody) "${run[@]}" 2>complained <"$input" | : ; code=${PIPESTATUS[0]} ;;
  esac
  is_one_of "$code" "124 137" && hung "${*:2} with standard output $1"
  sound "taut ${*:2}, standard output $1"
}

trial() {
  local work=${works[(number - 1) % ${#works[@]}]} where=${whereto[((number - 1) / ${#works[@]} + number - 1) % ${#whereto[@]}]}
  input=$ground/script
  : >complained
  with_output "$where" $work
  harmed
  case $where in
    # 141: SIGPIPE ended the command; 0: all output was written before the reader ended
    nobody) is_one_of "$code" "0 4 141" || wrong "exit code $code: taut $work, standard output unread: $(complaint)" ;;
    *) [[ $code == 4 ]] || wrong "exit code $code, not 4: taut $work, standard output $where: $(complaint)" ;;
  esac
  [[ ! -e out ]] || same_run "$ground/out" out
  for piece in plot.svg panel.png movie.gif; do [[ ! -e $piece || -s $piece ]] || torn "$piece is empty"; done
  no_rests .
}
