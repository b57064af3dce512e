# Functions shared by the kinds of faults. A kind is a file in kinds/ with the functions
#
#   prepare   makes, once, the files that trials compare with or copy, in $ground
#   trial     injects faults in the empty current folder $here, and checks the results
#
# and a line `harm="..."`, its description for --list.

scene=$faults/discs.toml
patience=${TAUT_FAULTS_PATIENCE:-60}  # s

lost() { found lost "$@"; }
torn() { found torn "$@"; }
crashed() { found crashed "$@"; }
hung() { found hung "$@"; }
wrong() { found wrong "$@"; }
found() { printf '%s\t%s\t%s\t%s\n' "$1" "$kind" "$number" "$(tr '\n' ' ' <<<"${*:2}")" >>"$findings"; }

# Counts a fault that took effect.
harmed() { echo "$kind" >>"$harms"; }

# pick N: sets $picked to 0 ... N-1; to 0 for N = 0
pick() { picked=$(($1 > 0 ? (RANDOM << 15 | RANDOM) % $1 : 0)); }
# choose WORD...: sets $chosen to one of the words
choose() { pick $#; chosen=${@:picked+1:1}; }
nap() { sleep "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; }  # ms

input=/dev/null  # standard input of the program

# taut ARGUMENT...: runs the program; sets $code
taut() {
  code=0
  timeout --kill-after 1 "$patience" "$program" "$@" >"$here/said" 2>"$here/complained" <"$input" || code=$?
  [[ $code != 124 && $code != 137 ]] || hung "no end after $patience s: taut $*"
  sound "taut $*"
}

# sound WHAT: checks that the program that ended with $code has not crashed
sound() {
  case $code in
    132 | 134 | 135 | 136 | 139) crashed "signal $((code - 128)): $1" ;;
    70) crashed "$1: $(complaint)" ;;
  esac
  ! grep -qE 'AddressSanitizer|runtime error|ThreadSanitizer' "$here/complained" || crashed "sanitizer: $1"
}

# ends CODES ARGUMENT...: like taut; the exit code must be one of CODES
ends() {
  taut "${@:2}"
  is_one_of "$code" "$1" || wrong "exit code $code, not ${1// / or }: taut ${*:2}: $(complaint)"
}
is_one_of() { [[ " $2 " == *" $1 "* ]]; }
complaint() { tail -n 1 "$here/complained" 2>/dev/null | cut -c 1-300; }

# start ARGUMENT...: runs the program in the background, as $victim
start() {
  LC_ALL=C env --default-signal "$program" "$@" >"$here/said" 2>"$here/complained" <"$input" &
  victim=$!
}
going() { kill -0 "$victim" 2>/dev/null; }

# await CONDITION...: polls until CONDITION succeeds; returns 1 if the victim has ended before
await() {
  until "$@" 2>/dev/null; do
    going || return 1
    sleep 0.002
  done
}

# finish WHAT: waits for the victim; sets $code
finish() {
  local waited=0
  while going && ((waited++ < patience * 20)); do sleep 0.05; done
  if going; then
    hung "no end after $patience s: $1"
    kill -KILL "$victim"
  fi
  code=0
  wait "$victim" 2>/dev/null || code=$?
  sound "$1"
}

# strike SIGNALS: sends signals, like "INT INT", in a row; sets $struck to 1 if a signal hit
strike() {
  struck=0
  local signal
  for signal in $1; do
    kill -s "$signal" "$victim" 2>/dev/null && struck=1
  done
  ((!struck)) || harmed
}

# strike_at_random SIGNALS WITHIN ARGUMENT...: starts the program and strikes after 0 ... WITHIN ms
strike_at_random() {
  start "${@:3}"
  pick "$2"
  nap "$picked"
  strike "$1"
  finish "taut ${*:3} (SIG$1 after $picked ms)"
}

# how_long ARGUMENT...: runs the program; sets $took, in ms
how_long() {
  local from=${EPOCHREALTIME/./}
  taut "$@"
  took=$(((${EPOCHREALTIME/./} - from) / 1000 + 1))
}

# disk FOLDER KIB: mounts an empty disk of this size; returns 1 if mounting is not allowed
disk() { [[ $TAUT_FAULTS_MOUNTS == yes ]] && mkdir -p "$1" && mount -t tmpfs -o "size=$2k" none "$1"; }
# resize FOLDER KIB
resize() { mount -o "remount,size=$2k" "$1"; }
# read_only FOLDER: read-only for root too
read_only() { [[ $TAUT_FAULTS_MOUNTS == yes ]] && mount --bind "$1" "$1" && mount -o remount,bind,ro "$1"; }

# record FOLDER: prints run.json without entries that vary between repetitions
record() { sed -E '/^  "provenance": \{/,/^  \}/d; /"(setup|solve|cpu|render|write|particle_steps_per_second|threads|machine)":/d' "$1/run.json"; }

# same_run GOOD FOLDER: the folder equals GOOD, an undisturbed run
same_run() {
  local differs
  differs=$(diff -rq --exclude run.json --exclude run.lock "$1" "$2" 2>&1) || lost "$(head -n 3 <<<"$differs")"
  differs=$(diff <(record "$1") <(record "$2") 2>&1) || lost "run.json: $(head -n 3 <<<"$differs" | tr '\n' ' ')"
}

# part_of_run FOLDER GOOD...: all files of a stopped run are complete; frames, particles, scene and rows are those of an
# undisturbed run GOOD
part_of_run() {
  local folder=$1 file
  for file in "$folder"/frames/*.png; do [[ ! -e $file ]] || as_in_one "$frames_are" "$file" "${@:2}"; done
  for file in "$folder"/particles/*.vtp "$folder"/scene.toml; do
    [[ ! -e $file ]] || as_in_one "cmp -s" "$file" "${@:2}"
  done
  for file in "$folder"/history.csv "$folder"/lines.csv; do
    [[ ! -s $file ]] || as_in_one same_rows "$file" "${@:2}"
  done
  [[ ! -e $folder/run.json ]] || whole_json "$folder/run.json"
  file=$folder/particles/particles.pvd
  [[ ! -e $file || $(tail -n 1 "$file") == '</VTKFile>' ]] || torn "$file is incomplete"
}

# cmp, or whole_png if the colour range depends on the frames drawn so far
frames_are="cmp -s"
whole_png() { [[ $(tail -c 8 "$1" | od -An -tx1) == " 49 45 4e 44 ae 42 60 82" ]]; }

# as_in_one SAME FILE GOOD...: the command SAME accepts FILE and its namesake in one of the folders GOOD
as_in_one() {
  local good
  for good in "${@:3}"; do $1 "$2" "$good/${2#"$folder/"}" && return; done
  torn "$2 is incomplete or differs"
}

# same_rows FILE GOOD: FILE ends with a whole row; all but the last row, written at the stop, are the first rows of GOOD
same_rows() {
  local rows
  [[ -e $2 && -z $(tail -c 1 "$1") ]] || return 1
  rows=$(($(wc -l <"$1") - 1))
  cmp -s <(head -n "$rows" "$1") <(head -n "$rows" "$2")
}

whole_json() { [[ $(tail -n 1 "$1") == "}" && $(head -n 1 "$1") == "{" ]] || torn "$1 is incomplete"; }

# old_or_new PATH OLD NEW: the file or folder PATH equals OLD or NEW, or does not exist if one of them is ""
old_or_new() {
  local state
  for state in "$2" "$3"; do
    if [[ -z $state ]]; then
      [[ -e $1 ]] || return 0
    elif [[ -e $1 ]] && diff -rq "$1" "$state" >/dev/null; then
      return 0
    fi
  done
  torn "$1 is neither the old nor the new version"
}

status() { sed -n 's/^  "status": "\(.*\)",$/\1/p' "$1/run.json" 2>/dev/null; }

# no_rests FOLDER: no temporary file is left
no_rests() {
  local rests
  rests=$(find "$1" -name '*.tmp*' -o -name '*.part' -o -name '*.old[0-9]*' | head -n 3 | tr '\n' ' ')
  [[ -z $rests ]] || lost "temporary files are left: $rests"
}

# by_signal SIGNAL: prints the exit code of a program that SIGNAL ended
by_signal() { echo $((128 + $(kill -l "$1"))); }

# stopped_by SIGNALS: checks that one of SIGNALS ended a struck program, or that the program finished before
stopped_by() {
  local signal codes=0
  ((!struck)) || for signal in $1; do codes+=" $(by_signal "$signal")"; done
  is_one_of "$code" "$codes" || wrong "exit code $code after ${1:+SIG${1// / SIG}}: $(complaint)"
}

# sums FOLDER: prints checksums of all files except the lock, which is created before the signal handlers are set
sums() { find "$1" -type f ! -name run.lock -exec md5sum {} + | sort; }
