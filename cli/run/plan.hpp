#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/drawing/options.hpp"
#include "cli/run/run.hpp"

namespace taut::cli {

class Options;

/// The options of `taut run` as typed; what is left out stands in the scene.
struct RunOptions {
  std::string scene;
  std::vector<Setting> settings;  // --method, --spacing, --until; behind them --set, which counts before them
  std::optional<std::string> out;
  bool out_named = true;  // by the user, not by a sweep
  std::optional<double> every, history;
  std::optional<int> frames;
  DrawingOptions drawing;
  int threads = 0;                         // 0 = all cores, fewer in small scenes
  std::optional<double> checkpoint_every;  // s
  bool no_render = false;
  bool save_particles = false;
  std::vector<std::string> fields;  // of the particles saved; none = all
};

/// --method, --set, --spacing, --until: what is simulated.
void declare_setting_options(Options& command, RunOptions& options);
/// --frames, --every, --history and the drawing options: what is left of it.
void declare_output_options(Options& command, RunOptions& options);

/// --save-particles, --fields.
void declare_particle_options(Options& command, RunOptions& options);

/// Throws UsageError for far more threads, or what else the option counts, than there are cores.
void check_threads(int threads, std::string_view option = "--threads");
/// The scene with what the options change about what is simulated. Throws UsageError and SceneError.
SceneFile scene_to_run(const RunOptions& options);

/// The remark of a scene's reading, where there is one.
void tell(const SceneFile& file, std::ostream& err);

/// Reads and checks all there is to check, without touching the run folder. Throws UsageError and SceneError.
RunPlan make_plan(const RunOptions& options);

/// The fields that are saved of particles; none: particles are not.
std::vector<const Field*> particle_fields(const RunOptions& options, int dim);

/// Throws UsageError, with the nearest names, for a verdict that does not exist or cannot be failed on.
std::optional<Verdict> parse_verdict(const std::optional<std::string>& text);

}  // namespace taut::cli
