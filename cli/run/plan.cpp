#include "cli/run/plan.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

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

/// Before anything is said about the scene, which reads differently with each method.
void check_methods(const std::vector<Setting>& settings) {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.emplace_back(m.name);
  for (const Setting& setting : settings)
    if (setting.name == "method" && !find_method(setting.value))
      throw UsageError(unknown_name("method", setting.value, names));
}

void put_first(std::vector<Setting>& settings, Setting setting) {
  settings.insert(settings.begin(), std::move(setting));
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

}  // namespace

std::vector<const Field*> particle_fields(const RunOptions& options, int dim) {
  std::vector<const Field*> chosen;
  if (options.save_particles && options.fields.empty())
    for (const Field& field : fields(dim)) chosen.push_back(&field);
  for (const std::string& key : options.fields)
    if (const Field& field = known_field(key, dim); std::ranges::find(chosen, &field) == chosen.end())
      chosen.push_back(&field);
  return chosen;
}

void declare_setting_options(CLI::App& app, RunOptions& o) {
  app.add_option_function<std::string>(
         "--method",
         [&o](const std::string& name) {
           put_first(o.settings, {"method", name});
         },
         "`taut list methods`; default: the scene's")
      ->option_text("METHOD");
  app.add_option_function<std::vector<std::string>>(
         "--set",
         [&o](const std::vector<std::string>& assignments) {
           for (const std::string& text : assignments) o.settings.push_back(parse_setting(text));
         },
         "a parameter of the scene, or method.NAME: a constant of the method")
      ->option_text("NAME=VALUE ...")
      ->allow_extra_args(false)
      ->check(assignment);
  app.add_option_function<double>(
         "--spacing",
         [&o](double spacing) {
           o.spacing = spacing;
           put_first(o.settings, {"spacing", exact(spacing)});
         },
         "of the particles, m; rounded so that it divides the first body")
      ->option_text("DP")
      ->check(positive_number);
  app.add_option_function<double>(
         "--until",
         [&o](double until) {
           put_first(o.settings, {"until", exact(until)});
         },
         "end of the run, s")
      ->option_text("T")
      ->check(positive_number);
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
  check_methods(options.settings);
  SceneFile file = read_scene(find_scene(options.scene), options.settings);
  file.settings.threads = options.threads;
  return file;
}

void tell(const SceneFile& file, std::ostream& err) {
  if (!file.remark.empty()) err << "taut: " << file.remark << '\n';
}

RunPlan make_plan(const RunOptions& options) {
  RunPlan plan;
  SceneFile& file = plan.file;
  file = scene_to_run(options);
  file.drawing = with_options(file.drawing, options.drawing);
  suit(file.drawing, file);
  file.drawing.frames = frame_count(options, file);
  file.history = history_interval(options, file);
  plan.folder = RunFolder(options.out.value_or("out/" + file.scene.name + "-" + file.settings.method));
  plan.spacing_asked = options.spacing;
  plan.checkpoint_every = options.checkpoint_every;
  if (!options.no_render) plan.drawing = file.drawing;
  plan.particle_fields = particle_fields(options, file.scene.dim);
  if (plan.drawing || !plan.particle_fields.empty())
    plan.frame_times = times_in_parts(file.scene.until, file.drawing.frames);
  plan.history_times = times_every(file.scene.until, *file.history);
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
