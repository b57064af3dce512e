#include "cli/commands/commands.hpp"

namespace taut::cli {

std::function<int(Streams)> declare_run(CLI::App&);
std::function<int(Streams)> declare_render(CLI::App&);
std::function<int(Streams)> declare_sweep(CLI::App&);
std::function<int(Streams)> declare_chart(CLI::App&);
std::function<int(Streams)> declare_map(CLI::App&);
std::function<int(Streams)> declare_choose(CLI::App&);
std::function<int(Streams)> declare_plot(CLI::App&);
std::function<int(Streams)> declare_check(CLI::App&);
std::function<int(Streams)> declare_compare(CLI::App&);
std::function<int(Streams)> declare_movie(CLI::App&);
std::function<int(Streams)> declare_diff(CLI::App&);
std::function<int(Streams)> declare_snapshot(CLI::App&);
std::function<int(Streams)> declare_critical_step(CLI::App&);
std::function<int(Streams)> declare_session(CLI::App&);
std::function<int(Streams)> declare_list(CLI::App&);
std::function<int(Streams)> declare_describe(CLI::App&);
std::function<int(Streams)> declare_completion(CLI::App&);

namespace {

constexpr Command table[] = {
    {"run", "simulate a scene; leaves frames, histories and a verdict in a run folder",
     "  taut run colliding-rings\n"
     "  taut run colliding-rings --method og --set v0=0.12 --fail-on fractured\n"
     "  taut run colliding-rings --color pressure --range -2e6:2e6 --size 1920x1080 --out out/rings\n"
     "  taut run out/rings/scene.toml             the same run again\n"
     "  taut run colliding-rings --checkpoint-every 1e-3 --out out/rings\n"
     "  taut run --resume out/rings               goes on where it was interrupted or killed\n",
     declare_run},
    {"render", "draw a run again from its saved particles, with other colours, ranges, views or sizes",
     "  taut render out/rings --color pressure --range -2e6:2e6\n"
     "  taut render out/rings --view -0.01:0.01:-0.04:0.04 --size 800x800 --out out/close\n",
     declare_render},
    {"sweep", "run a scene with every combination of some values; a table of verdicts and measures",
     "  taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog\n"
     "  taut sweep colliding-rings --grid spacing=0.002,0.001 --grid method.zeta=3,3.5,4 --set v0=0.1\n"
     "  taut sweep rings-speed-limit --list       a sweep file of scenes/studies/: what would run\n"
     "  taut sweep rings-speed-limit --jobs 1     goes on where it was stopped\n"
     "  taut sweep plate-accuracy                 a study with a [chart] or a [map] is drawn as well\n"
     "  taut sweep rings-speed-limit --out limits --emit slurm && sbatch limits/sweep.slurm\n",
     declare_sweep},
    {"chart", "draw error (up) over cost (to the right) from the results of sweeps, a line for each method",
     "  taut sweep oscillating-plate --grid method=enog,oenog,tl --grid spacing=0.004,0.002,0.001"
     " --out out/plate\n"
     "  taut chart out/plate/results.csv --out plate.png\n"
     "  taut chart out/plate --measure first_peak --cost steps --methods enog,tl --out plate.svg\n"
     "  taut chart out/mine --against oenog --out mine.png     no reference: against its finest run\n"
     "  taut chart out/plate --markdown           tables only; also --json\n"
     "plate.gp and plate.dat stay beside the picture: "
     "change the script, and `gnuplot plate.gp` draws it again.\n",
     declare_chart},
    {"map",
     "show where each method fails from the results of sweeps: a parameter by methods, and the verdicts",
     "  taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog --out out/speeds\n"
     "  taut map out/speeds/results.csv --out speeds.png\n",
     declare_map},
    {"choose",
     "say which method and spacing reach an accuracy at the least cost, from sweeps; exit code 1 if none",
     "  taut choose colliding-rings               what each accuracy costs\n"
     "  taut choose colliding-rings --error 1% --measure rebound_ratio\n"
     "  taut choose oscillating-plate --error 0.5% --seconds 10 --from out/plate-accuracy\n"
     "It only reads what sweeps have left, by default below out/. When that does not reach far enough,\n"
     "it says so, and the exit code is 1.\n",
     declare_choose},
    {"plot", "draw columns of histories of runs over time, or over each other",
     "  taut plot out/plate-enog --out tip.png    the probes, a panel each\n"
     "  taut plot out/tl out/oenog --columns tip,total_energy --out runs.svg\n"
     "  taut plot out/disc --columns force --x gap --out force-displacement.png\n"
     "plot.gp and plot.dat stay beside the picture.\n",
     declare_plot},
    {"compare", "draw runs side by side from their saved particles: columns are runs, rows are times",
     "  taut compare out/og out/enog --out panel.png\n"
     "  taut compare out/og out/enog --times 0.002,0.005,0.012 --color pressure --range -2e6:2e6"
     " --out panel.png\n",
     declare_compare},
    {"movie", "make a movie of a run's frames, with ffmpeg",
     "  taut movie out/rings --out rings.mp4\n"
     "  taut movie out/rings --out rings.gif --fps 15\n",
     declare_movie},
    {"diff", "compare two images or two folders of frames; exit code 0 when alike, 1 when different",
     "  taut diff out/a out/b                     the frames of two runs, name by name\n"
     "  taut diff a/frames/frame_00060.png b/frames/frame_00060.png\n"
     "  taut diff a.png b.png --max-difference 2 --out diff.png\n",
     declare_diff},
    {"snapshot", "run a scene and compare its frames with a baseline; exit code 1 when they differ",
     "  taut snapshot my.toml --baseline baselines/my --frames 4 --size 320x180 --update     makes it\n"
     "  taut snapshot my.toml --baseline baselines/my --frames 4 --size 320x180              checks\n",
     declare_snapshot},
    {"check",
     "compare measures and the verdict of a run with what they should be; exit code 1 when one has moved",
     "  taut check out/plate-enog --measure 'period=0.2545±1%' --verdict stable\n"
     "  taut check out/rings --measure 'rebound_ratio>0.8' --measure touch_time=0.0021+-1e-4\n"
     "  taut check out/rings --baseline good/run.json --tolerance 1%\n"
     "A run that has not finished, or a measure without a value, is not fine.\n",
     declare_check},
    {"critical-step", "find the largest stable time step of a scene and a method, by bisection",
     "  taut critical-step colliding-rings --method tl\n"
     "  taut critical-step loaded-square --set method.h=0.45 --steps 500\n"
     "  taut critical-step rotating-plate --spacing 0.1 --json\n"
     "Each trial starts anew with a fixed step and covers the same time. "
     "It is unstable once the energy is 100 times\n"
     "what was given or a number is lost; small random velocities wake what could grow.\n",
     declare_critical_step},
    {"session", "commands on stdin, answers on stdout: step, look, change, save; `help` lists them",
     "  taut session colliding-rings\n"
     "  printf 'run until 0.003\\nprobe\\nframe now.png\\n' | taut session colliding-rings --strict\n"
     "Every answer ends with a line `ok` or `error: REASON`; values come as name=value.\n",
     declare_session},
    {"list",
     "name what there is: scenes, methods, laws, shapes, probes, measures, keys of scene files and more",
     "  taut list\n"
     "  taut list methods\n"
     "  taut list keys                            of scene and sweep files, all in one table\n"
     "  taut list scenes --json\n",
     declare_list},
    {"describe", "say what a scene or a method is, or how scene and sweep files are written",
     "  taut describe colliding-rings             its parameters with units and bounds, bodies, measures\n"
     "  taut describe enog                        its equations, constants with bounds, source\n"
     "  taut describe scene-file                  everything that a scene file may have\n"
     "  taut describe body                        one section of it; or a shape, a probe, a measure\n"
     "  taut describe sweep-file\n",
     declare_describe},
    {"completion", "print what a shell needs to complete commands, options and names at the press of Tab",
     "  source <(taut completion bash)            now; in ~/.bashrc: from now on\n"
     "  source <(taut completion zsh)             the same in ~/.zshrc, behind compinit\n",
     declare_completion},
};

}  // namespace

std::span<const Command> commands() { return table; }

}  // namespace taut::cli
