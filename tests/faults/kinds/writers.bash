harm="two programs use one folder at once: one completes, the other is refused with the reason"

# first command | second command, started during the first; A and B differ in the speed
pairs=(
  "run A|run B" "run A|run A" "run A|snapshot B" "snapshot B|run A" "run A|resume" "resume|resume" "resume|run B"
  "run A|render" "render|run B" "render|render" "sweep|sweep" "sweep|run in it" "run in it|sweep" "sweep|render in it"
)

common=(--quiet --save-particles --fields speed)

# command_of WORD: sets $command
command_of() {
  case $1 in
    "run A") command=(run "$scene" "${common[@]}" --checkpoint-every 0.001 --out out) ;;
    "run B") command=(run "$scene" --set speed=1 "${common[@]}" --out out) ;;
    "snapshot B") command=(snapshot "$scene" --set speed=1 --quiet --baseline baseline --update --out out) ;;
    resume) command=(run --resume out --quiet) ;;
    render) command=(render out --quiet --range 0:2) ;;
    sweep) command=(sweep "$scene" --grid speed=0.4,1 "${common[@]}" --render --jobs 2 --out out) ;;
    "run in it") command=(run "$scene" "${common[@]}" --out "$in_it") ;;
    "render in it") command=(render "$in_it" --quiet --range 0:2) ;;
  esac
}
in_it=out/speed=0.4

# lay WORD: prepares the folder
lay() {
  case $1 in
    resume) cp -a "$ground/stopped" out ;;
    render) cp -a "$ground/A" out ;;
    *"in it") cp -a "$ground/sweep" out ;;
  esac
}

# whole WORD: the folder contains the result of that command alone
whole() {
  case $1 in
    "run A" | resume) same_run "$ground/A" out ;;
    "run B") same_run "$ground/B" out ;;
    "snapshot B") same_run "$ground/snapshot" out ;;
    render) same_run "$ground/drawn" out ;;
    sweep) same_run "$ground/sweep/speed=0.4" "$in_it"; same_run "$ground/sweep/speed=1" out/speed=1 ;;
    "run in it") same_run "$ground/sweep/speed=0.4" "$in_it" ;;
    "render in it") same_run "$ground/drawn-in-it" "$in_it" ;;
  esac
}

# alone WORD FOLDER: stores the result of that command alone
alone() {
  command_of "$1"
  [[ $2 != B ]] || how_long "${command[@]}"
  ends 0 "${command[@]}"
  mv out "$2"
}

prepare() {
  alone "run B" B
  alone "snapshot B" snapshot
  alone sweep sweep
  alone "run A" A
  cp -a A out && alone render drawn
  cp -a sweep out; command_of "render in it"; ends 0 "${command[@]}"; mv "$in_it" drawn-in-it; rm -r out
  command_of "run A"
  start "${command[@]}"
  await test -e out/particles/particles_00003.vtp
  kill -KILL "$victim"
  finish "taut ${command[*]}"
  mv out stopped
}

trial() {
  local first second one two
  IFS='|' read -r first second <<<"${pairs[(number - 1) % ${#pairs[@]}]}"
  lay "$first"
  [[ -e out || $second != *"in it" ]] || cp -a "$ground/sweep" out
  command_of "$first"
  mkdir one && "$program" "${command[@]}" >one/said 2>one/complained </dev/null &
  local other=$!
  pick "$took"
  nap $((10 + picked / 2))
  command_of "$second"
  taut "${command[@]}"
  two=$code
  one=0
  wait "$other" || one=$?
  harmed
  case $one:$two in
    0:2) refused complained; whole "$first" ;;
    2:0) refused one/complained; whole "$second" ;;
    # one after the other
    0:0) whole "$second" ;;
    *) wrong "'$first' and '$second' at once end with $one and $two: $(tail -n 1 one/complained) $(complaint)" ;;
  esac
}

# refused FILE: the message contains the reason, or the lock holder
refused() {
  grep -qE 'in use by .taut [a-z]+. .process [0-9]+|is finished|nothing is left to do' "$1" ||
    wrong "'$first' and '$second': refused with $(tail -n 1 "$1")"
}
