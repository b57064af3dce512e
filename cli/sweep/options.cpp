#include "cli/sweep/options.hpp"

#include <algorithm>
#include <filesystem>
#include <sys/auxv.h>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/sweep/emit.hpp"
#include "cli/sweep/sweep_file.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

std::string path_of_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) return program.string();
  // path by which the program was started
  return fs::absolute(reinterpret_cast<const char*>(::getauxval(AT_EXECFN))).string();
}

bool draws(const SweepOptions& o) {
  // with saved particles, --frames and --every set their times
  const bool times_of_frames = o.run.save_particles.empty() && (o.run.frames || o.run.every);
  return o.render || times_of_frames || o.run.drawing.any();
}

SweepRequest request_of_scene(const SweepOptions& o) {
  const fs::path scene = find_scene(o.what);
  if (is_sweep_file(scene))
    throw UsageError(
        fmt::format("'{}' is a sweep file with its own grid; leave --grid out, or name a scene", o.what));
  std::vector<Axis> axes;
  for (const std::string& text : o.grid) axes.push_back(parse_axis(text));
  SweepRequest request;
  request.base = o.run;
  request.base.scene = scene.string();
  request.rows = all_combinations(axes);
  request.folder = o.run.out.value_or(fmt::format("out/{}-sweep", scene.stem().string()));
  return request;
}

SweepRequest request_of_file(const SweepOptions& o) {
  SweepFile file = read_sweep(find_sweep(o.what));
  SweepRequest request;
  request.title = file.title;
  request.file = file.path;
  request.base = o.run;
  request.base.scene = file.scene;
  std::erase_if(file.set, [&](const Setting& s) {
    return std::ranges::find(o.run.settings, s.name, &Setting::name) != o.run.settings.end();
  });
  request.set = std::move(file.set);
  request.rows = std::move(file.rows);
  request.repeat = file.repeat;
  request.pictures = std::move(file.pictures);
  request.folder = o.run.out.value_or("out/" + file.path.stem().string());
  return request;
}

}  // namespace

void declare_sweep_options(Options& command, SweepOptions& o) {
  command
      .add_argument("SWEEP", o.what,
                    "sweep file, or its name in scenes/studies/; with --grid, a scene as for `taut run`")
      .required();
  command
      .add("--grid", "NAME=VALUES", o.grid,
           "name that --set takes, such as a parameter, method, spacing or jitter, and its values: "
           "v1,v2,... or lo:hi:step, both ends included; several --grid give every combination")
      .one_word_each();
  command.add_flag("--list", o.list, "list the runs and their states; run nothing");
  command.add("--jobs", "N", o.jobs, "number of runs at a time; default: cores divided by --threads")
      .check(positive_whole_number);
  command
      .add("--repeat", "N", o.repeat,
           "number of times that each run is made; the median cost counts; "
           "above 1, at most one thread per physical core; default: the sweep file's, else 1")
      .check(positive_whole_number);
  command.add("--index", "N", o.index, "do only run N; the first run is 0").check(whole_number);
  command.add_flag("--force", o.force, "repeat finished runs");
  command.add("--emit", join(emit_names(), "|"), o.emit,
              "write a script that does the runs: a Slurm array job, or GNU parallel");
  command.add("--out", "DIR", o.run.out, "folder for results and runs; default: out/FILE or out/SCENE-sweep");
  declare_setting_options(command, o.run);
  command.add_flag("--render", o.render, "draw frames; drawing options imply it");
  declare_output_options(command, o.run);
  declare_particle_options(command, o.run);
  o.run.threads = 1;
  command.add("--threads", "N", o.run.threads, "number of threads of each run; default: 1")
      .check(positive_whole_number);
  command.add("--fail-on", "VERDICT", o.fail_on, "end with exit code 3 if a verdict is this one or worse");
  command.add_flag("--quiet", o.quiet, "print no progress on stderr");
}

SweepRequest make_request(const SweepOptions& o) {
  SweepRequest request = o.grid.empty() ? request_of_file(o) : request_of_scene(o);
  request.base.no_render = !draws(o);
  request.repeat = o.repeat.value_or(request.repeat);
  if (request.repeat > most_repetitions)
    throw UsageError(fmt::format("--repeat is {}; at most {} are allowed", request.repeat, most_repetitions));
  return request;
}

std::vector<std::string> command_to_repeat(const Options& command) {
  const std::vector<std::string> passing = {"--list", "--jobs",  "--index", "--force",
                                            "--emit", "--quiet", "--json",  "--junit"};
  std::vector<std::string> words{path_of_program(), "sweep"};
  for (const Option& option : command.all()) {
    if (std::ranges::find(passing, option.name()) != passing.end()) continue;
    for (const std::string& value : option.values()) {
      if (!option.is_positional())
        words.push_back(option.name() + (option.takes_value() || value != "true" ? "=" + value : ""));
      else
        words.push_back(value.starts_with('-') ? "./" + value : value);
    }
  }
  return words;
}

}  // namespace taut::cli
