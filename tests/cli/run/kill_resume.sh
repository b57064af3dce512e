#!/bin/bash
# Kills checkpointed runs at random moments (kill -9) and resumes them; what is left must be the bytes of runs
# that nobody killed. A longer form of the test "runs that are killed at any moment ..." (test_resume.cpp).
#
#   tests/cli/run/kill_resume.sh [PROGRAM [KILLS [SEED]]]        default: build/taut, 50, 1
#
# The methods of `taut list methods` take turns. Exit code 0: all as they should be; 1: one was not.
set -eu
program=$(realpath "${1:-$(dirname "$0")/../../../build/taut}")
kills=${2:-50}
RANDOM=${3:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > discs.toml <<'SCENE'
title = "Two discs"
dim = 2
spacing = 0.002
until = 0.1
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "left"
shape = { type = "disc", centre = [-0.011, 0], radius = 0.01 }
material = "rubber"
velocity = [2, 0]
[[body]]
name = "right"
shape = { type = "disc", centre = [0.011, 0], radius = 0.01 }
material = "rubber"
velocity = [-2, 0]
[[probe]]
name = "gap"
of = "gap"
bodies = ["left", "right"]
[[measure]]
name = "least_gap"
of = "minimum"
probe = "gap"
unit = "m"
[render]
color = "speed"
size = [160, 120]
frames = 10
SCENE

# run.json without what differs from one run to the next: times and speed
record() { sed -E '/"(setup|solve|render|write|particle_steps_per_second|threads)":/d' "$1/run.json"; }

# to its end or to its divergence, and its frames are drawn
has_ended() { [ ! -e out/checkpoint.bin ] && grep -qE '"status": "(finished|failed)"' out/run.json 2> /dev/null; }

same() {
  diff -rq --exclude run.json straight out && diff <(record straight) <(record out)
}

mapfile -t methods < <("$program" list methods --json | grep -o '"name": *"[^"]*"' | cut -d'"' -f4)
killed=0 rounds=0
while [ "$killed" -lt "$kills" ]; do
  method=${methods[$((rounds++ % ${#methods[@]}))]}
  rm -rf straight out
  options=(discs.toml --method "$method" --threads 1 --quiet --save-particles --fields pressure)
  "$program" run "${options[@]}" --out straight > /dev/null || [ $? -eq 3 ]  # a method may diverge
  again=("${options[@]}" --checkpoint-every 0.001 --out out)
  for _ in 1 2 3 4 5; do
    "$program" run "${again[@]}" > /dev/null 2>&1 &
    sleep "0.$(printf %03d $((RANDOM % 400)))"
    if kill -9 $! 2> /dev/null; then killed=$((killed + 1)); fi
    wait $! 2> /dev/null || true
    # killed before it had begun: once more; before its first checkpoint, --resume begins it anew
    [ -e out/checkpoint.bin ] && again=(--resume out --threads 1 --quiet)
    has_ended && break
  done
  has_ended || "$program" run "${again[@]}" > /dev/null || [ $? -eq 3 ]
  same || { echo "$method: not the same after kills"; exit 1; }
  echo "$method: the same ($killed kills so far)"
done
