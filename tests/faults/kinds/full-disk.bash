harm="the disk is full while a command writes: exit code 4 and nothing torn; a run or sweep continues once there is room"

options=(--threads 1 --quiet --save-particles --fields pressure,speed)
works=(run run run sweep session movie chart panel baseline drawn)

prepare() {
  ends 0 run "$scene" "${options[@]}" --out straight
  ends 0 run "$scene" --set speed=1 "${options[@]}" --out other
  ends 0 sweep "$scene" --grid speed=0.4,0.8 --grid method=enog,oenog --until 0.02 --quiet --out sweep
  ends 0 snapshot "$scene" --until 0.01 --out x --baseline old --update --quiet
  ends 0 snapshot "$scene" --until 0.01 --set speed=1 --out new-run --baseline new --update --quiet
  ends 0 compare straight --out old.png
  ends 0 compare straight other --out new.png
  ends 0 movie straight --fps 10 --out old.mp4
  ends 0 movie other --out new.mp4
  printf 'run until 0.01\nsave state\nrun until 0.02\nsave state\nframe now.png\n' >script
}

# succeeds_or_lacks_room ARGUMENT...: the command must succeed, or exit with 4 and the reason
succeeds_or_lacks_room() {
  ends "0 4" "$@"
  [[ $code != 4 ]] || { harmed; gives_the_reason; }
}
gives_the_reason() { grep -qE '(No space left on device|File too large|ffmpeg failed|gnuplot failed)' "$here/complained" "$here/said" || wrong "no reason: $(complaint)"; }

# small_disk KIB: mounts a disk of a random size up to KIB and changes to it; without mounts, limits the file size
small_disk() {
  pick "$1"
  room=$((4 + picked / 4 * 4))
  disk disk "$room" && cd disk || { cd "$here" && mkdir -p disk && cd disk && ulimit -f "$room"; }
}
more_room() { [[ $TAUT_FAULTS_MOUNTS == yes ]] && resize . 20000; }

of_run() {
  choose 0.0003 0.001 0.01; local every=$chosen
  small_disk 500
  succeeds_or_lacks_room run "$scene" "${options[@]}" --checkpoint-every "$every" --out out
  [[ $code == 4 ]] || return
  part_of_run out "$ground/straight"
  if [[ -e out/run.json ]]; then
    is_one_of "$(status out)" "failed running" || wrong "run.json has status '$(status out)' after a full disk"
    [[ $(status out) != failed ]] || grep -q '"reason"' out/run.json || wrong "run.json of a failed run has no reason"
  fi
  more_room || return
  if [[ -e out/checkpoint.bin ]]; then
    ends 0 run --resume out --quiet
  else
    ends 0 run "$scene" "${options[@]}" --checkpoint-every "$every" --out out
  fi
  same_run "$ground/straight" out
}

of_sweep() {
  small_disk 300
  local grid=(sweep "$scene" --grid speed=0.4,0.8 --grid method=enog,oenog --until 0.02 --quiet --out out) folder
  succeeds_or_lacks_room "${grid[@]}"
  [[ $code == 4 ]] || return
  for folder in out/*/; do part_of_run "${folder%/}" "$ground/sweep/$(basename "$folder")"; done
  more_room || return
  ends 0 "${grid[@]}"
  for folder in "$ground"/sweep/*/; do same_run "${folder%/}" "out/$(basename "$folder")"; done
}

of_session() {
  small_disk 120
  input=$ground/script
  succeeds_or_lacks_room session "$scene" --strict --threads 1
  input=/dev/null
  [[ $code == 4 ]] || return
  printf 'load state\n' >../load
  [[ ! -e state ]] || { input=../load; ends 0 session "$scene" --strict; input=/dev/null; }
}

# overwrite NAME OLD NEW ARGUMENT...: the command must replace OLD by NEW, or keep OLD and exit with 4
overwrite() {
  local name=$1 old=$2 new=$3
  shift 3
  small_disk "$(($(du -sk "$old" "$new" | awk '{ sum += $1 } END { print sum }') * 2))"
  [[ $TAUT_FAULTS_MOUNTS == yes ]] || return
  cp -a "$old" "$name" 2>/dev/null || return  # no room for the old version
  succeeds_or_lacks_room "$@"
  if [[ $code == 4 ]]; then old_or_new "$name" "$old" "$old"; else old_or_new "$name" "$new" "$new"; fi
  no_rests .
}

of_movie() { overwrite a.mp4 "$ground/old.mp4" "$ground/new.mp4" movie "$ground/other" --out a.mp4; }
of_panel() { overwrite a.png "$ground/old.png" "$ground/new.png" compare "$ground/straight" "$ground/other" --out a.png; }
of_baseline() {
  overwrite base "$ground/old" "$ground/new" \
    snapshot "$scene" --until 0.01 --set speed=1 --out "$here/run" --baseline base --update --quiet
}
of_chart() { small_disk 60; succeeds_or_lacks_room chart "$ground/sweep" --out chart.png; no_rests .; }
of_drawn() {
  local file
  small_disk 60
  succeeds_or_lacks_room render "$ground/straight" --quiet --out drawn
  for file in drawn/*.png; do [[ ! -e $file ]] || old_or_new "$file" "" "$ground/straight/frames/$(basename "$file")"; done
}

trial() {
  of_"${works[(number - 1) % ${#works[@]}]}"
  cd "$here" || exit 2
  ulimit -S -f unlimited
  [[ $TAUT_FAULTS_MOUNTS != yes ]] || umount --lazy disk
}
