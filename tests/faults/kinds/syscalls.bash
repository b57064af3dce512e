harm="the n-th write, rename, open, fsync ... fails: exit code 0, 2 or 4; or kills the program: nothing torn (needs strace)"

options=(--threads 1 --quiet --save-particles --fields speed)
calls=(read pread64 write openat rename renameat2 fsync ftruncate mkdir unlink close lseek newfstatat getdents64 mmap fcntl)

can_trace() { strace -e trace=none -o /dev/null true 2>/dev/null; }

prepare() {
  can_trace || { echo "syscalls: skipped, since strace is missing or not permitted" >&2; return; }
  ends 0 run "$scene" --until 0.02 "${options[@]}" --out run
  ends 0 run "$scene" --until 0.02 "${options[@]}" --set speed=1 --out other
  ends 0 snapshot "$scene" --until 0.02 --threads 1 --quiet --out x --update --baseline old
  ends 0 snapshot "$scene" --until 0.02 --threads 1 --quiet --out x --set speed=1 --update --baseline new
  ends 0 compare run --out old.png
  ends 0 compare other --out new.png
}

works=(run run resume baseline panel drawn)

trial() {
  local call at how promised="0 2 4"
  can_trace || return
  choose "${calls[@]}"; call=$chosen
  # the first calls belong to the loader; most calls of a run are writes
  pick "$([[ $call == write ]] && echo 150 || echo 40)"; at=$((picked + 1))
  choose error=ENOSPC error=EIO error=EACCES error=EINTR signal=KILL signal=KILL; how=$chosen
  [[ $call != close || $how == signal=KILL ]] || how=error=EIO
  [[ $how != signal=KILL ]] || promised="0 137"
  choose "${works[@]}"; local work=$chosen
  case $work in
    run) command=(run "$scene" --until 0.02 "${options[@]}" --checkpoint-every 0.004 --out out) ;;
    resume)
      start run "$scene" --until 0.02 "${options[@]}" --checkpoint-every 0.002 --out out
      await test -e out/particles/particles_00003.vtp
      kill -KILL "$victim" 2>/dev/null
      finish "taut run"
      [[ -e out/checkpoint.bin ]] || return 0
      command=(run --resume out --quiet --threads 1) ;;
    baseline)
      cp -a "$ground/old" base
      command=(snapshot "$scene" --until 0.02 --threads 1 --quiet --out x --set speed=1 --update --baseline base) ;;
    panel) cp "$ground/old.png" panel.png; command=(compare "$ground/other" --out panel.png) ;;
    drawn) command=(render "$ground/run" --threads 1 --quiet --out drawn) ;;
  esac
  code=0
  timeout --kill-after 1 "$patience" strace -f -o trace -e trace="$call" -e inject="$call:$how:when=$at" \
    "$program" "${command[@]}" >said 2>complained </dev/null || code=$?
  ! grep -qE 'INJECTED|SIGKILL' trace || harmed
  local what="$work, $how at $call number $at"
  [[ $code != 124 ]] || hung "$what"
  sound "$what"
  # 127: the fault hit the loader
  is_one_of "$code" "$promised 127" || wrong "exit code $code: $what: $(complaint)"
  case $work in
    run | resume)
      [[ ! -d out ]] || part_of_run out "$ground/run"
      [[ $code != 0 ]] || same_run "$ground/run" out
      if [[ -e out/checkpoint.bin ]]; then
        ends 0 run --resume out --quiet
        same_run "$ground/run" out
      fi ;;
    baseline) old_or_new base "$ground/old" "$ground/new" ;;
    panel) old_or_new panel.png "$ground/old.png" "$ground/new.png" ;;
    drawn) for file in drawn/*.png; do [[ ! -e $file ]] || old_or_new "$file" "" "$ground/run/frames/${file##*/}"; done ;;
  esac
}
