# Sourced by run: what the kinds of faults share. A kind is a file in kinds/ with the functions
#
#   prepare   makes in the folder $ground, once, what all trials compare with or copy
#   trial     does one harm to the program, in the empty folder $here (the current one), and looks at what it left
#
# and a line `harm="..."`, what is done, for --help. What a trial finds it says with lost, torn, crashed, hung and wrong.

scene=$faults/discs.toml
patience=${TAUT_FAULTS_PATIENCE:-60}  # s until what does not end counts as hung

# ---- what was found

# lost: what had been written is not there, or not the bytes that nobody disturbed. torn: a file is neither its old nor
# its new state. crashed: a signal, or "a bug of taut". hung: no end. wrong: another exit code or message than promised.
lost() { found lost "$@"; }
torn() { found torn "$@"; }
crashed() { found crashed "$@"; }
hung() { found hung "$@"; }
wrong() { found wrong "$@"; }
found() { printf '%s\t%s\t%s\t%s\n' "$1" "$kind" "$number" "$(tr '\n' ' ' <<<"${*:2}")" >>"$findings"; }

# One more harm was done: a kill that hit, a disk that was full.
harmed() { echo "$kind" >>"$harms"; }

# ---- chance: by the seed and the number of the trial, nothing else

# pick N: $picked is 0 ... N-1, and 0 of nothing
pick() { picked=$(($1 > 0 ? (RANDOM << 15 | RANDOM) % $1 : 0)); }
# choose WORD...: $chosen is one of them
choose() { pick $#; chosen=${@:picked+1:1}; }
nap() { sleep "$(($1 / 1000)).$(printf %03d $(($1 % 1000)))"; }  # ms

# ---- the program

input=/dev/null  # what it reads

# taut ARGUMENT...: runs it to its end; $code, and what it said in the files said and complained of $here
taut() {
  code=0
  timeout --kill-after 1 "$patience" "$program" "$@" >"$here/said" 2>"$here/complained" <"$input" || code=$?
  [[ $code != 124 && $code != 137 ]] || hung "no end after $patience s: taut $*"
  sound "taut $*"
}

# sound WHAT: what just ended with $code has not crashed
sound() {
  case $code in
    132 | 134 | 135 | 136 | 139) crashed "signal $((code - 128)): $1" ;;
    70) crashed "$1: $(complaint)" ;;
  esac
  ! grep -qE 'AddressSanitizer|runtime error|ThreadSanitizer' "$here/complained" || crashed "sanitizer: $1"
}

# ends WITH ARGUMENT...: the same, and the exit code is one of the words of WITH
ends() {
  taut "${@:2}"
  is_one_of "$code" "$1" || wrong "exit code $code, not ${1// / or }: taut ${*:2}: $(complaint)"
}
is_one_of() { [[ " $2 " == *" $1 "* ]]; }
complaint() { tail -n 1 "$here/complained" 2>/dev/null | cut -c 1-300; }

# start ARGUMENT...: runs it in the background, as $victim, with the signals as a terminal gives them
start() {
  LC_ALL=C env --default-signal "$program" "$@" >"$here/said" 2>"$here/complained" <"$input" &
  victim=$!
}
going() { kill -0 "$victim" 2>/dev/null; }

# await CONDITION...: looks again and again until the command succeeds; 1 if the victim has ended before
await() {
  until "$@" 2>/dev/null; do
    going || return 1
    sleep 0.002
  done
}

# finish WHAT: waits for the victim; $code
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

# strike SIGNALS: sends them, as "KILL" or "INT INT", one right after the other; $struck says if they hit
strike() {
  struck=0
  local signal
  for signal in $1; do
    kill -s "$signal" "$victim" 2>/dev/null && struck=1
  done
  ((!struck)) || harmed
}

# strike_at_random SIGNALS WITHIN ARGUMENT...: starts it, and strikes after 0 ... WITHIN ms
strike_at_random() {
  start "${@:3}"
  pick "$2"
  nap "$picked"
  strike "$1"
  finish "taut ${*:3} (SIG$1 after $picked ms)"
}

# how_long ARGUMENT...: $took is how many ms it takes when nobody disturbs it
how_long() {
  local from=${EPOCHREALTIME/./}
  taut "$@"
  took=$(((${EPOCHREALTIME/./} - from) / 1000 + 1))
}

# ---- disks

# disk FOLDER KIB: mounts an empty one of this size there; 1 where that is not allowed
disk() { [[ $TAUT_FAULTS_MOUNTS == yes ]] && mkdir -p "$1" && mount -t tmpfs -o "size=$2k" none "$1"; }
# resize FOLDER KIB
resize() { mount -o "remount,size=$2k" "$1"; }
# read_only FOLDER: a view of the folder through which nobody, root neither, can write
read_only() { [[ $TAUT_FAULTS_MOUNTS == yes ]] && mount --bind "$1" "$1" && mount -o remount,bind,ro "$1"; }

# ---- what is whole

# record FOLDER: run.json without what differs from one run to the next: times, speed, threads, provenance
record() { sed -E '/^  "provenance": \{/,/^  \}/d; /"(setup|solve|render|write|particle_steps_per_second|threads|machine)":/d' "$1/run.json"; }

# same_run GOOD FOLDER: the folder holds the bytes of a run that nobody disturbed, and nothing else
same_run() {
  local differs
  differs=$(diff -rq --exclude run.json --exclude run.lock "$1" "$2" 2>&1) || lost "$(head -n 3 <<<"$differs")"
  differs=$(diff <(record "$1") <(record "$2") 2>&1) || lost "run.json: $(head -n 3 <<<"$differs" | tr '\n' ' ')"
}

# part_of_run FOLDER GOOD...: whatever a stopped run has left is whole, and as in one of the runs GOOD, which nobody
# disturbed
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
  [[ ! -e $file || $(tail -n 1 "$file") == '</VTKFile>' ]] || torn "$file is not whole"
}

# how frames compare: to the byte, or (whole_png) only as pictures, where the range is that of what was drawn so far
frames_are="cmp -s"
whole_png() { [[ $(tail -c 8 "$1" | od -An -tx1) == " 49 45 4e 44 ae 42 60 82" ]]; }

# as_in_one SAME FILE GOOD...: the file of $folder passes SAME with the one of that name in one of the folders
as_in_one() {
  local good
  for good in "${@:3}"; do $1 "$2" "$good/${2#"$folder/"}" && return; done
  torn "$2 is not whole"
}

# same_rows FILE GOOD: whole rows of GOOD from its first one on; the last may be another one, of the end
same_rows() {
  local rows
  [[ -e $2 && -z $(tail -c 1 "$1") ]] || return 1
  rows=$(($(wc -l <"$1") - 1))
  cmp -s <(head -n "$rows" "$1") <(head -n "$rows" "$2")
}

# every object and array is closed, in one pass and without a parser: taut writes it with an end of line
whole_json() { [[ $(tail -n 1 "$1") == "}" && $(head -n 1 "$1") == "{" ]] || torn "$1 is not whole"; }

# old_or_new PATH OLD NEW: a file, or all of a folder, is in one of two states; "" for a state that is not there
old_or_new() {
  local state
  for state in "$2" "$3"; do
    if [[ -z $state ]]; then
      [[ -e $1 ]] || return 0
    elif [[ -e $1 ]] && diff -rq "$1" "$state" >/dev/null; then
      return 0
    fi
  done
  torn "$1 is neither as before nor as it shall be"
}

# status FOLDER: of run.json
status() { sed -n 's/^  "status": "\(.*\)",$/\1/p' "$1/run.json" 2>/dev/null; }

# no_rests FOLDER: no file in the making is left
no_rests() {
  local rests
  rests=$(find "$1" -name '*.tmp*' -o -name '*.part' -o -name '*.old[0-9]*' | head -n 3 | tr '\n' ' ')
  [[ -z $rests ]] || lost "is left: $rests"
}

# by_signal SIGNAL: the exit code of a program that SIGNAL ended, in good order or at once
by_signal() { echo $((128 + $(kill -l "$1"))); }

# stopped_by SIGNALS: a struck program has ended by one of them, or has finished before
stopped_by() {
  local signal codes=0
  ((!struck)) || for signal in $1; do codes+=" $(by_signal "$signal")"; done
  is_one_of "$code" "$codes" || wrong "exit code $code after ${1:+SIG${1// / SIG}}: $(complaint)"
}

# sums FOLDER: of all files but the lock, which comes before handlers of signals, to see that nothing has changed
sums() { find "$1" -type f ! -name run.lock -exec md5sum {} + | sort; }
