#include "cli/run/plan.hpp"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "cli/drawing/keys.hpp"
#include "cli/run/schedule.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "engine/families/catalogue.hpp"

namespace taut::cli {
namespace {

constexpr int default_history_rows = 1000;

Overrides overrides(const RunOptions& options) {
  Overrides result;
  for (const std::string& text : options.set) {
    const std::size_t at = text.find('=');
    result.set.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  result.method = options.method;
  result.spacing = options.spacing;
  result.until = options.until;
  return result;
}

void check_method(const std::optional<std::string>& given) {
  if (!given || find_method(*given)) return;
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.emplace_back(m.name);
  throw UsageError(unknown_name("method", *given, names));
}

int frame_count(const RunOptions& options, const SceneFile& file) {
  constexpr double most = 1e6;
  const double count = options.frames  ? *options.frames
                       : options.every ? std::fmax(1, std::round(file.scene.until / *options.every))
                                       : file.drawing.frames;
  if (count > most)
    throw UsageError("that makes more than a million frames; take fewer --frames or a longer --every");
  return static_cast<int>(count);
}

double history_interval(const RunOptions& options, const SceneFile& file) {
  constexpr double most_rows = 1e7;
  const double interval =
      options.history.value_or(file.history.value_or(file.scene.until / default_history_rows));
  if (file.scene.until / interval > most_rows)
    throw UsageError("--history " + brief(interval) + " makes more than 10 million rows; take a longer one");
  return interval;
}

std::vector<const Field*> particle_fields(const RunOptions& options) {
  std::vector<const Field*> chosen;
  if (options.save_particles && options.fields.empty())
    for (const Field& field : fields()) chosen.push_back(&field);
  for (const std::string& key : options.fields)
    if (const Field& field = known_field(key); std::ranges::find(chosen, &field) == chosen.end())
      chosen.push_back(&field);
  return chosen;
}

}  // namespace

void declare_setting_options(CLI::App& app, RunOptions& o) {
  app.add_option("--method", o.method, "`taut list methods`; default: the scene's")->option_text("METHOD");
  app.add_option("--set", o.set, "a parameter of the scene, or method.NAME: a constant of the method")
      ->option_text("NAME=VALUE ...")
      ->allow_extra_args(false)
      ->check(assignment);
  app.add_option("--spacing", o.spacing, "of the particles, m; rounded so that it divides the first body")
      ->option_text("DP")
      ->check(positive_number);
  app.add_option("--until", o.until, "end of the run, s")->option_text("T")->check(positive_number);
}

void declare_output_options(CLI::App& app, RunOptions& o) {
  const DrawingKey& key = drawing_key("frames");
  auto* frames = app.add_option("--frames", o.frames, std::string(key.help))
                     ->option_text(std::string(key.placeholder))
                     ->check(positive_whole_number);
  app.add_option("--every", o.every, "time between frames, s; rounded so that the last one shows the end")
      ->option_text("DT")
      ->check(positive_number)
      ->excludes(frames);
  app.add_option("--history", o.history,
                 "time between rows of history.csv, s; default: a thousandth of the run")
      ->option_text("DT")
      ->check(positive_number);
  declare_drawing_options(app, o.drawing);
}

void declare_particle_options(CLI::App& app, RunOptions& o) {
  auto* save =
      app.add_flag("--save-particles", o.save_particles,
                   "particles/*.vtp with each frame, for `taut render`, `taut compare` and ParaView");
  app.add_option("--fields", o.fields, "the fields saved with them (`taut list fields`); default: all")
      ->option_text("FIELD,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs(save);
}

SceneFile scene_to_run(const RunOptions& options) {
  check_method(options.method);
  SceneFile file = read_scene(find_scene(options.scene), overrides(options));
  file.settings.threads = options.threads;
  return file;
}

RunPlan make_plan(const RunOptions& options) {
  RunPlan plan;
  SceneFile& file = plan.file;
  file = scene_to_run(options);
  file.drawing = with_options(file.drawing, options.drawing);
  file.drawing.frames = frame_count(options, file);
  file.history = history_interval(options, file);
  plan.spacing_asked = options.spacing;
  if (!options.no_render) plan.drawing = file.drawing;
  plan.particle_fields = particle_fields(options);
  if (plan.drawing || !plan.particle_fields.empty())
    plan.frame_times = times_in_parts(file.scene.until, file.drawing.frames);
  plan.history_times = times_every(file.scene.until, *file.history);
  plan.folder = RunFolder(options.out.value_or("out/" + file.scene.name + "-" + file.settings.method));
  plan.folder.check();
  return plan;
}

std::optional<Verdict> parse_verdict(const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  const std::vector<std::string> names = names_of_failures();
  if (std::ranges::find(names, *text) != names.end()) return find_verdict(*text);
  throw UsageError(unknown_name("verdict", *text, names));
}

}  // namespace taut::cli
