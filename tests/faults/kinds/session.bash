harm="a session that saves repeatedly is interrupted: its state file is a saved version, and continues to the same numbers"

steps=(0.005 0.01 0.015 0.02 0.03 0.04 0.05 0.06 0.07 0.08)
session=(session "$scene" --threads 1)

prepare() {
  local t
  for t in "${steps[@]}"; do printf 'run until %s\nsave state\nframe now.png\n' "$t"; done >script
  for t in "${steps[@]}"; do printf 'run until %s\nsave state-%s\nframe frame-%s.png\n' "$t" "$t" "$t"; done >straight
  printf 'run until 0.09\nprobe\ninfo\n' >>straight
  input=straight
  ends 0 "${session[@]}"
  tail -n +$((1 + 3 * ${#steps[@]})) said | grep -A99 '^gap=' >answer
  input=script
  how_long "${session[@]}"
}

# one_of FILE PATTERN: FILE, if it exists, equals a version that the undisturbed session saved
one_of() {
  local good
  [[ -e $1 ]] || return 0
  for good in "$ground"/$2; do cmp -s "$1" "$good" && return; done
  torn "$1 differs from all saved versions"
}

trial() {
  choose KILL KILL TERM INT HUP; local signals=$chosen
  input=$ground/script
  strike_at_random "$signals" "$took" "${session[@]}"
  stopped_by "$signals"
  one_of state 'state-*'
  one_of now.png 'frame-*.png'
  [[ -e state ]] || return 0
  printf 'load state\nrun until 0.09\nprobe\ninfo\n' >goes-on
  input=goes-on
  ends 0 "${session[@]}" --strict
  diff "$ground/answer" <(grep -A99 '^gap=' said) >differs || lost "continues to other numbers: $(head -n 3 differs | tr '\n' ' ')"
}
