# For each task, `run` sources this file in a new empty folder and calls one function. The functions `command_…` run
# every command of the program.

short_run() {  # SCENE METHOD SPACING UNTIL
  taut run "$1" --method "$2" --spacing "$3" --until "$4" --threads 2 --frames 2 --size 160x120 --save-particles \
    --quiet --out run
}

short_session() {  # SCENE METHOD SPACING
  taut session "$1" --method "$2" --spacing "$3" --threads 2 --size 160x120 --strict <<'END'
step 20
save state
step 5
load state
set cfl=0.1
step 5
probe
frame a.png
END
}

# Interrupts a run once it has a checkpoint, and resumes it.
resumed() {  # SCENE METHOD SPACING UNTIL
  local code=0
  "$taut" run "$1" --method "$2" --spacing "$3" --until "$(times "$4" 3)" --checkpoint-every "$(times "$4" 0.2)" \
    --threads 2 --no-render --quiet --out run &
  until [[ -e run/checkpoint.bin ]] || ! kill -0 $! 2>/dev/null; do sleep 0.01; done
  kill -INT $! 2>/dev/null || true
  wait $! || code=$?
  ((code == 130)) || return $code
  taut run --resume run --quiet
}

times() { awk -v a="$1" -v b="$2" 'BEGIN {printf "%.6g", a * b}'; }

# expect CODE COMMAND...
expect() {
  local code=0
  "${@:2}" || code=$?
  ((code == $1)) || { echo "exit code $code instead of $1: ${*:2}" >&2; return 99; }
}

rings() {  # OUT OPTION...
  taut run colliding-rings --spacing 0.004 --until 4e-4 --frames 3 --size 320x180 --save-particles --quiet \
    --threads 2 --out "$@"
}
balls() {
  taut run colliding-balls --spacing 0.005 --until 1e-4 --frames 2 --size 320x180 --save-particles --quiet \
    --threads 2 --out "$@"
}

command_words() {
  local what shell
  taut --help
  taut --version
  for what in run render sweep chart map choose plot report compare movie diff snapshot check critical-step session list \
    describe completion; do
    taut "$what" --help
  done
  taut list
  for what in scenes methods equations laws contacts shapes probes measures fields colormaps keys; do
    taut list $what --json
  done
  for shell in bash zsh; do taut completion $shell; done
  taut claims
  taut claims --run Zhang2024.fig-6a --jobs 1
  taut --complete claims --run ''
  taut --complete run colliding-rings --set ''
  taut --complete run colliding-rings --set v0
  taut --complete run colliding-r
  taut --complete render ''
  expect 2 taut run colliding-ring
  expect 2 taut run colliding-rings --set v=1
  expect 2 taut nothing
}

command_describe() {
  local what
  for what in $(taut list methods --json | sed -n 's/^ *"name": "\(.*\)".*/\1/p') scene-file sweep-file claim-file suite-file body measure; do
    taut describe "$what"
  done
  for what in scene-file sweep-file claim-file suite-file body; do taut describe $what --json; done
  for what in scene-file sweep-file claim-file suite-file; do taut describe $what --schema; done
  for what in $(taut list scenes --json | sed -n 's/^ *"name": "\(.*\)".*/\1/p'); do taut describe "$what"; done
}

command_draw() {
  local field
  rings run
  taut render run --range auto --view auto --threads 2
  for field in $(taut list fields --json | sed -n 's/^ *"name": "\(.*\)".*/\1/p'); do
    taut render run --color "$field" --size 160x120 --quiet --out "$field" || [[ $? == 2 ]]
  done
  taut render run --color '=speed^2/2' --style cells --cut 'x > 0.02' --follow left --background '#102030' \
    --text none --threads 2 --out other
  taut render run --color pressure --colormap rainbow --glyph 0.8 --range -1e4:1e4 --view -0.1:0:-0.06:0.06 --out third
  rings oenog --range auto --method oenog
  taut compare run oenog --out panel.png
  taut diff run other --out difference.png || [[ $? == 1 ]]
  expect 0 taut diff run/frames/frame_00001.png run/frames/frame_00001.png
  taut report run oenog --out page
  taut report run --baseline other --embed --json
}

command_draw_solid() {
  local style
  balls run --method oenog --cut 'x > 0' --camera 2:1:1
  for style in spheres cells; do
    taut render run --style $style --fov 30 --up 0:1:0 --range auto --threads 2 --out $style
  done
  taut compare run --out panel.png
  if [[ $(type -P ffmpeg) ]]; then
    taut movie run --out run.gif
    taut movie run --orbit --out orbit.mp4
  fi
}

command_snapshot() {
  local words=(colliding-rings --spacing 0.004 --until 4e-4 --frames 2 --size 160x120 --quiet)
  taut snapshot "${words[@]}" --baseline mine --update
  taut snapshot "${words[@]}" --baseline mine --json --junit mine.xml
  expect 1 taut snapshot "${words[@]}" --baseline mine --set v0=0.12
  taut snapshot rings-and-balls --only rings --jobs 2 --quiet --baseline suite --update
  taut snapshot rings-and-balls --only rings,faster-rings --jobs 2 --quiet --baseline suite --json --junit suite.xml
  taut report out/snapshot-rings-and-balls
  taut snapshot rings-and-balls --list
}

command_sweep() {
  local words=(colliding-rings --grid method=og,oenog,tl --grid spacing=0.004,0.003 --until 4e-4 --out rings --quiet)
  taut sweep "${words[@]}" --list
  taut sweep "${words[@]}" --jobs 2 --threads 2 --render --frames 2 --size 160x120
  taut sweep "${words[@]}" --index 1 --force --json --junit rings.xml
  taut sweep "${words[@]}" --emit slurm
  taut sweep "${words[@]}" --emit parallel
  taut chart rings --measure least_diameter --against oenog --out chart.svg
  taut chart rings --measure least_diameter --against oenog --cost steps --methods og,tl --out chart.png \
    --markdown
  taut chart rings --measure least_diameter --against oenog --json
  taut map rings --parameter spacing --out map.png --json
  taut report rings
  taut choose colliding-rings --from rings --measure mirror_asymmetry --set until=4e-4 --json
  taut choose colliding-rings --from rings --measure mirror_asymmetry --set until=4e-4 --error 1 || [[ $? == 1 ]]
  taut sweep rings-accuracy --list
}

command_numbers() {
  rings run
  rings other --method tl
  taut plot run other --out plot.svg
  taut plot run --columns total_energy+kinetic_energy,gap --x t --width 85mm --out plot.png
  taut run rotating-plate --spacing 0.1 --until 0.09 --no-render --quiet --threads 2 --out plate
  taut plot plate --lines pressure_across+von_mises_across --times 0.09 --out lines.svg
  taut check run --verdict diverged --measure 'conservation.energy<1'
  taut check run --baseline run --tolerance '1%' --json --junit run.xml
  expect 1 taut check run --measure 'conservation.energy<0'
  taut critical-step colliding-rings --spacing 0.004 --steps 20 --tolerance 0.1 --threads 2 --json
  taut critical-step colliding-balls --spacing 0.005 --steps 5 --tolerance 0.2 --threads 2
}

session_words='info
step
step 3
run until 1e-4
color pressure
range 0 1e5
range auto
colormap rainbow
view pan 0.01 0
view zoom 2
view fit
view 0 1 0 1
follow left
follow none
glyph 0.8
background black
text none
cut x > 0
frame a.png
preview
style cells
cut none
color =speed^2/2
frame b.png
probe
set cfl=0.1
set method.nothing=1
step 2
save state
load state
load nothing
step 2
help
help step
nonsense
'

command_session() {
  printf '%s' "$session_words" 'quit' | taut session colliding-rings --spacing 0.004 --threads 2 --size 160x120
  printf '%s' "$session_words" $'camera 1 1 1\nup 0 0 1\nfov 20\norbit 30 10\nstyle spheres\nframe c.png\n' |
    taut session colliding-balls --spacing 0.005 --threads 2 --size 160x120
  expect 2 taut session colliding-rings --strict <<<nonsense
}

command_terminal() {
  [[ $(type -P script) ]] || return 0
  printf 'st\t 3\ninfo\npreview\nrun until 1e-4\nquit\n' |
    script -qec "$taut session colliding-rings --spacing 0.004 --size 160x120" /dev/null
  script -qec "$taut run colliding-rings --spacing 0.004 --until 4e-4 --out run" /dev/null </dev/null
}
