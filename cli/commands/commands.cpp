#include "cli/commands/commands.hpp"

namespace taut::cli {

std::function<int(Streams)> declare_run(Options&);
std::function<int(Streams)> declare_render(Options&);
std::function<int(Streams)> declare_sweep(Options&);
std::function<int(Streams)> declare_chart(Options&);
std::function<int(Streams)> declare_map(Options&);
std::function<int(Streams)> declare_choose(Options&);
std::function<int(Streams)> declare_plot(Options&);
std::function<int(Streams)> declare_report(Options&);
std::function<int(Streams)> declare_check(Options&);
std::function<int(Streams)> declare_compare(Options&);
std::function<int(Streams)> declare_movie(Options&);
std::function<int(Streams)> declare_diff(Options&);
std::function<int(Streams)> declare_snapshot(Options&);
std::function<int(Streams)> declare_critical_step(Options&);
std::function<int(Streams)> declare_claims(Options&);
std::function<int(Streams)> declare_session(Options&);
std::function<int(Streams)> declare_list(Options&);
std::function<int(Streams)> declare_describe(Options&);
std::function<int(Streams)> declare_completion(Options&);

namespace {

constexpr Command table[] = {
    {"run", "simulate a scene; write frames, histories, measures and a verdict to a run folder",
     "  taut run colliding-rings\n"
     "  taut run colliding-rings --method og --set v0=0.12 --fail-on fractured\n"
     "  taut run colliding-rings --color pressure --range -2e6:2e6 --size 1920x1080 --out out/rings\n"
     "  taut run out/rings/scene.toml             repeat a run\n"
     "  taut run colliding-rings --checkpoint-every 1e-3 --out out/rings\n"
     "  taut run --resume out/rings               continue an interrupted or killed run\n",
     declare_run},
    {"render", "redraw a run from its saved particles, with other colours, ranges, views or sizes",
     "  taut render out/rings --color pressure --range -2e6:2e6\n"
     "  taut render out/rings --view -0.01:0.01:-0.04:0.04 --size 800x800 --out out/close\n",
     declare_render},
    {"sweep", "run a scene with every combination of some values; tabulate verdicts and measures",
     "  taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog\n"
     "  taut sweep colliding-rings --grid spacing=0.002,0.001 --grid method.zeta=3,3.5,4 --set v0=0.1\n"
     "  taut sweep rings-speed-limit --list       list the runs of a study in scenes/studies/\n"
     "  taut sweep rings-speed-limit --jobs 1     run or continue it, one run at a time\n"
     "  taut sweep plate-accuracy                 run a study and draw its pictures\n"
     "  taut sweep rings-speed-limit --out limits --emit slurm && sbatch limits/sweep.slurm\n",
     declare_sweep},
    {"chart", "draw error over cost from the results of sweeps, one line per method",
     "  taut sweep oscillating-plate --grid method=enog,oenog,tl --grid spacing=0.004,0.002,0.001 --out out/plate\n"
     "  taut chart out/plate/results.csv --out plate.png\n"
     "  taut chart out/plate --measure first_peak --cost steps --methods enog,tl --out plate.svg\n"
     "  taut chart out/mine --against oenog --out mine.png     errors relative to the finest run of oenog\n"
     "  taut chart out/plate --markdown           print tables only; also --json\n"
     "The gnuplot script plate.gp and its data plate.dat are written beside the picture.\n"
     "To change the picture, edit the script and run `gnuplot plate.gp`.\n",
     declare_chart},
    {"map",
     "draw verdicts or a measure from the results of sweeps: one parameter (x axis) by method (y axis)",
     "  taut sweep colliding-rings --grid v0=0.02:0.16:0.02 --grid method=og,oas,enog --out out/speeds\n"
     "  taut map out/speeds/results.csv --out speeds.png\n",
     declare_map},
    {"choose",
     "find the cheapest method and spacing for an accuracy, from sweeps; exit code 1 if there is none",
     "  taut choose colliding-rings               list the cost of each accuracy\n"
     "  taut choose colliding-rings --error 1% --measure rebound_ratio\n"
     "  taut choose oscillating-plate --error 0.5% --seconds 10 --from out/plate-accuracy\n"
     "The command reads the results of sweeps, by default all within three levels of folders below out/.\n"
     "It runs nothing.\n"
     "If no run qualifies, it prints the most accurate one and ends with exit code 1.\n",
     declare_choose},
    {"plot", "draw histories of runs over time, fields along lines, or measures of a sweep over a parameter",
     "  taut plot out/plate-enog --out tip.png    one panel per probe\n"
     "  taut plot out/tl out/oenog --columns tip,total_energy --out runs.svg\n"
     "  taut plot out/disc --columns force --x gap --out force-displacement.png\n"
     "  taut plot out/tl out/oenog --lines stress --times 0.002,0.004 --out profiles.png\n"
     "  taut plot out/sweep --x thickness --y deflection --by method --log xy --out deflection.pdf\n"
     "  taut plot out/tl --columns top+bottom --width 85mm --out figure.png\n"
     "The gnuplot script and its data, such as tip.gp and tip.dat, are written beside the picture.\n",
     declare_plot},
    {"report", "write a web page of runs, a sweep, a suite or differing pictures, to open in a browser",
     "  taut report out/rings                     frames, histories, measures: out/rings/report/index.html\n"
     "  taut report out/og out/enog --out out/two runs side by side\n"
     "  taut report out/speeds                    table, map and charts of a sweep or study\n"
     "  taut report out/b --baseline out/a        expected pictures, these pictures, and their differences\n"
     "  taut report out/rings --embed             one file: out/rings/report.html\n"
     "  taut report out/rings --watch             follow a run that goes on\n"
     "The page needs neither server nor network. Without --watch, it shows the results at the time of the command.\n",
     declare_report},
    {"compare", "draw runs side by side from their saved particles: one column per run, one row per time",
     "  taut compare out/og out/enog --out panel.png\n"
     "  taut compare out/og out/enog --times 0.002,0.005,0.012 --color pressure --range -2e6:2e6 --out panel.png\n",
     declare_compare},
    {"movie", "make a movie from the frames of a run, with ffmpeg",
     "  taut movie out/rings --out rings.mp4\n"
     "  taut movie out/rings --out rings.gif --fps 15\n",
     declare_movie},
    {"diff", "compare two images or two folders of frames; exit code 0 if they are alike, else 1",
     "  taut diff out/a out/b                     compare the frames of two runs by name\n"
     "  taut diff a/frames/frame_00060.png b/frames/frame_00060.png\n"
     "  taut diff a.png b.png --max-difference 2 --out diff.png\n",
     declare_diff},
    {"snapshot", "run a scene or a suite and compare its frames with baselines; exit code 1 if they differ",
     "  taut snapshot my.toml --baseline baselines/my --frames 4 --size 320x180 --update     create it\n"
     "  taut snapshot my.toml --baseline baselines/my --frames 4 --size 320x180              compare\n",
     declare_snapshot},
    {"check", "compare measures and the verdict of a run with expected values; exit code 1 if a check fails",
     "  taut check out/plate-enog --measure 'period=0.2545±1%' --verdict stable\n"
     "  taut check out/rings --measure 'rebound_ratio>0.8' --measure touch_time=0.0021+-1e-4\n"
     "  taut check out/rings --baseline good/run.json --tolerance 1% --junit rings.xml\n"
     "An unfinished run and a measure without a value also fail.\n",
     declare_check},
    {"critical-step", "find the largest stable time step of a scene and a method by bisection",
     "  taut critical-step colliding-rings --method tl\n"
     "  taut critical-step loaded-square --set method.h=0.45 --steps 500\n"
     "  taut critical-step rotating-plate --spacing 0.1 --json\n"
     "Each trial restarts the scene with a fixed time step and adds small random velocities that excite\n"
     "unstable modes. A trial is unstable if its energy exceeds 100 times the energy that the scene\n"
     "received, or if the simulation fails, for instance because a value is not finite.\n",
     declare_critical_step},
    {"claims",
     "list statements of the papers and whether they hold here; run them; exit code 1 if a claim differs",
     "  taut claims                               all papers\n"
     "  taut claims Zhang2024\n"
     "  taut claims Zhang2024.fig-3a              one claim, with the commands that repeat its runs\n"
     "  taut claims --run Zhang2024.fig-3a Zhang2024.fig-3b\n"
     "  taut claims Lee2016 --quick               run the claims of a paper that take seconds\n"
     "  taut claims --all --jobs 2 --json         run everything: hours\n"
     "Runs are kept in --out, and finished runs are not repeated. A claim `holds` if its criterion is true,\n"
     "holds `in part` if only the weaker criterion is true, and otherwise `does not hold`. A claim agrees if\n"
     "its runs give the recorded state and its `evidence` condition, if any, is true.\n",
     declare_claims},
    {"session", "simulate interactively: read commands from stdin, print answers; `help` lists the commands",
     "  taut session colliding-rings\n"
     "  printf 'run until 0.003\\nprobe\\nframe now.png\\n' | taut session colliding-rings --strict\n"
     "Each answer to a script ends with a line `ok` or `error: REASON`. Values are printed as name=value.\n",
     declare_session},
    {"list", "list scenes, methods, laws, shapes, probes, measures, keys of scene files and more",
     "  taut list\n"
     "  taut list methods\n"
     "  taut list keys                            all keys of scene, sweep, claim and suite files\n"
     "  taut list scenes --json\n",
     declare_list},
    {"describe",
     "explain a scene, a method, another listed name, or the format of scene, sweep, claim and suite files",
     "  taut describe colliding-rings             its parameters with units and bounds, bodies, measures\n"
     "  taut describe enog                        its equations, constants with bounds, source\n"
     "  taut describe scene-file                  all sections and keys of a scene file\n"
     "  taut describe body                        the section [[body]] of scene files\n"
     "  taut describe sweep-file\n"
     "  taut describe scene-file --schema         a JSON Schema, with which editors complete scenes\n",
     declare_describe},
    {"completion", "print a script for bash or zsh that completes commands, options and names with Tab",
     "  source <(taut completion bash)            for this shell; for all shells, put it into ~/.bashrc\n"
     "  source <(taut completion zsh)             for zsh; in ~/.zshrc, put it after compinit\n",
     declare_completion},
};

}  // namespace

std::span<const Command> commands() { return table; }

}  // namespace taut::cli
