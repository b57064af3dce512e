#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/drawing/kept_look.hpp"
#include "cli/drawing/options.hpp"
#include "cli/run/run.hpp"

namespace taut::cli {

class Options;

struct RunOptions {
  std::string scene;
  std::vector<Setting> settings;  // also of --method, --spacing and --until
  std::optional<std::string> out;
  bool out_named = true;                 // by the user
  std::optional<double> every, history;  // s; none: from the scene
  std::optional<int> frames;
  DrawingOptions drawing;
  std::optional<KeptLook> look;  // of a baseline
  bool keeps_look = false;
  int threads = 0;                         // 0: all cores, fewer in small scenes
  std::optional<double> checkpoint_every;  // s
  bool keep_checkpoint = false;
  bool no_render = false;
  std::string save_particles;       // empty: not saved
  std::string particle_precision;   // empty: double
  std::vector<std::string> fields;  // none: all
};

void declare_setting_options(Options& command, RunOptions& options);
void declare_output_options(Options& command, RunOptions& options);

void declare_particle_options(Options& command, RunOptions& options);

/// Throws UsageError for far more threads than cores.
void check_threads(int threads, std::string_view option = "--threads");
/// Throws UsageError and SceneError.
SceneFile scene_to_run(const RunOptions& options);
/// Applies the options to the text in `file`, without reading its path again.
SceneFile scene_to_run(const RunOptions& options, const SceneFile& file);

void print_remark(const SceneFile& file, std::ostream& err);

/// Does not touch the run folder. Throws UsageError and SceneError.
RunPlan make_plan(const RunOptions& options);

std::vector<const Field*> particle_fields(const RunOptions& options, int dim);

/// Throws UsageError for unknown names.
ParticleForm particle_form(const RunOptions& options);

/// Throws UsageError for unknown names and `stable`.
std::optional<Verdict> parse_verdict(const std::optional<std::string>& text);

}  // namespace taut::cli
