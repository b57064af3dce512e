#include "cli/run/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/drawing/keys.hpp"
#include "cli/run/history.hpp"
#include "cli/run/schedule.hpp"
#include "cli/scene/reference_table.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/core/machine.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/warnings.hpp"

namespace taut::cli {
namespace {

constexpr int default_history_rows = 1000;

/// Reports an unknown method before the scene is read.
void check_methods(const std::vector<Setting>& settings) {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.emplace_back(m.name);
  for (const Setting& setting : settings)
    if (setting.name == "method" && !find_method(setting.value))
      throw UsageError(unknown_name("method", setting.value, names));
}

void refuse_second(const std::vector<Setting>& settings, const std::string& name) {
  if (std::ranges::find(settings, name, &Setting::name) != settings.end())
    throw UsageError(fmt::format("--{0} and --set {0}=... set the same value; leave one of them out", name));
}

void put_first(std::vector<Setting>& settings, Setting setting) {
  refuse_second(settings, setting.name);
  settings.insert(settings.begin(), std::move(setting));
}

int frame_count(const RunOptions& options, const SceneFile& file) {
  constexpr double most = 1e6;
  const double count = options.frames  ? *options.frames
                       : options.every ? std::fmax(1, std::round(file.scene.until / *options.every))
                                       : file.drawing.frames;
  if (count > most)
    throw UsageError("the run would have more than a million frames; use fewer --frames or a longer --every");
  return static_cast<int>(count);
}

double history_interval(const RunOptions& options, const SceneFile& file) {
  constexpr double most_rows = 1e7;
  const double interval =
      options.history.value_or(file.history.value_or(file.scene.until / default_history_rows));
  if (file.scene.until / interval > most_rows)
    throw UsageError(
        fmt::format("a history interval of {} s would give more than 10 million rows; use a longer one",
                    brief(interval)));
  return interval;
}

std::optional<std::filesystem::path> run_folder_of(const SceneFile& file) {
  const RunFolder folder(std::filesystem::absolute(file.path).parent_path());
  std::error_code error;
  if (file.path.filename() != folder.scene().filename() || !std::filesystem::exists(folder.record(), error))
    return std::nullopt;
  return folder.path();
}

/// "-spacing=0.002-v0=0.08". `again`: the scene is the scene.toml of a run folder.
std::string changes_text(const SceneFile& file, bool again) {
  constexpr std::size_t longest = 120;
  using enum ResolvedSetting::Source;
  std::vector<ResolvedSetting> all = file.resolved;
  std::ranges::sort(all, {}, &ResolvedSetting::name);
  std::string text;
  for (const ResolvedSetting& each : all) {
    const bool of_copy = !again && each.source == scene &&
                         std::ranges::count(file.parameters, each.name, &Parameter::name) > 0;
    if (each.name != "method" && (each.source == setting || of_copy))
      text += fmt::format("-{}={}", each.name, each.value);
  }
  return text.size() <= longest ? text : text.substr(0, longest) + fmt::format("-{:x}", hash_of(text));
}

std::string default_folder(const SceneFile& file) {
  const auto left = run_folder_of(file);
  const std::string changes = changes_text(file, left.has_value());
  if (!left) return fmt::format("out/{}-{}{}", file.scene.name, file.settings.method, changes);
  const bool changed = file.find_resolved("method")->source == ResolvedSetting::Source::setting;
  return fmt::format("out/{}-again{}{}", left->filename().string(), changed ? "-" + file.settings.method : "",
                     changes);
}

std::string no_use(const RunOptions& options) {
  if (!options.no_render) return "";
  std::vector<std::string> names;
  for (const auto& [key, value] : options.drawing.typed)
    if (value) names.push_back(drawing_key(key).option());
  if (options.save_particles.empty()) {
    if (options.frames) names.emplace_back("--frames");
    if (options.every) names.emplace_back("--every");
  }
  return names.empty() ? "" : "without effect, since no frames are drawn: " + join(names);
}

void refuse_second_columns(const SceneFile& file) {
  std::vector<std::string> columns = history_columns(file.scene);
  for (const Probe& probe : file.scene.probes)
    if (std::ranges::count(columns, probe.name) > 1)
      throw locate(file, SceneError("probe." + probe.name,
                                    fmt::format("history.csv already has a column '{}'; rename the probe",
                                                probe.name)));
}

std::string lines_without_samples(const Scene& scene) {
  std::string text;
  for (const SampleLine& line : scene.lines) {
    const auto late = std::ranges::count_if(line.times, [&](double t) { return t > scene.until; });
    if (late > 0)
      text += (text.empty() ? "" : "; ") +
              fmt::format(
                  "line '{0}' has no samples at its times after the end of the run, {3} s: {1} of {2} times",
                  line.name, late, line.times.size(), brief(scene.until));
  }
  return text;
}

}  // namespace

std::vector<const Field*> particle_fields(const RunOptions& options, int dim) {
  std::vector<const Field*> chosen;
  if (!options.save_particles.empty() && options.fields.empty())
    for (const Field& field : fields(dim)) chosen.push_back(&field);
  for (const std::string& key : options.fields)
    if (const Field& field = known_field(key, dim); std::ranges::find(chosen, &field) == chosen.end())
      chosen.push_back(&field);
  return chosen;
}

ParticleForm particle_form(const RunOptions& options) {
  const auto index = [](const char* kind, const std::string& given, const std::vector<std::string>& names) {
    const auto known = std::ranges::find(names, given);
    if (known == names.end() && !given.empty()) throw UsageError(unknown_name(kind, given, names));
    return given.empty() ? 0 : known - names.begin();
  };
  const std::vector<std::string> formats(particle_formats.begin(), particle_formats.end());
  return {static_cast<ParticleFormat>(index("format of particles", options.save_particles, formats)),
          index("--particle-precision", options.particle_precision, {"double", "single"}) == 1};
}

namespace {

std::string number_or_expression(const std::string& text) {
  const auto number = parsed<double>(text);
  return number ? exact(*number) : text;
}

}  // namespace

void declare_setting_options(Options& command, RunOptions& o) {
  command.add(
      "--method", "METHOD",
      [&o](const std::string& name) {
        put_first(o.settings, {"method", name});
      },
      "formulation (`taut list methods`); default: the method of the scene");
  command
      .add(
          "--set", "NAME=VALUE",
          [&o](const std::vector<std::string>& assignments) {
            const std::vector<Setting> by_options = o.settings;
            for (const std::string& text : assignments) {
              Setting setting = parse_setting(text);
              refuse_second(by_options, setting.name);
              o.settings.push_back(std::move(setting));
            }
          },
          "change a parameter of the scene, a constant of the method (method.NAME) or a setting such as cfl; "
          "can be repeated")
      .one_word_each()
      .check(assignment);
  const auto declare_number = [&](const std::string& name, const char* help, const char* placeholder) {
    command.add(
        "--" + name, placeholder,
        [&o, name](const std::string& text) {
          put_first(o.settings, {name, number_or_expression(text)});
        },
        help);
  };
  declare_number(
      "spacing",
      "particle spacing dp, m, a number or an expression such as 1/14; rounded to divide the first body; "
      "default: the scene's",
      "DP");
  declare_number("until", "end of the run, s; default: the scene's", "T");
}

void declare_output_options(Options& command, RunOptions& o) {
  const DrawingKey& key = drawing_key("frames");
  const Option frames =
      command.add("--frames", key.placeholder, o.frames, key.help).check(positive_whole_number);
  command
      .add("--every", "DT", o.every, "time between frames, s; rounded so that the last frame shows the end")
      .check(positive_number)
      .excludes(frames);
  command
      .add("--history", "DT", o.history,
           "time between rows of history.csv, s; default: the scene's, else 1/1000 of the run")
      .check(positive_number);
  declare_drawing_options(command, o.drawing);
}

void declare_particle_options(Options& command, RunOptions& o) {
  const Option save = command.add_flag(
      "--save-particles", {particle_formats.begin(), particle_formats.end()}, o.save_particles,
      "write a file into particles/ with each frame: "
      "vtp (the default) for `taut render`, `taut compare` and ParaView, extended xyz for OVITO and ASE, or csv");
  command
      .add("--fields", "FIELD,...", o.fields,
           "fields to save with the particles (`taut list fields`); default: all")
      .comma_separated()
      .needs(save);
  command
      .add("--particle-precision", "double|single", o.particle_precision,
           "digits of saved particles; "
           "single halves the files, but pictures of `taut render` may differ from those of the run; "
           "default: double")
      .needs(save);
}

void check_threads(int threads, std::string_view option) {
  constexpr int per_core = 8;
  const int most = std::max(2 * per_core, per_core * cores());
  if (threads > most)
    throw UsageError(fmt::format("{} is {}; at most {} are allowed, since this machine has {} cores", option,
                                 threads, most, cores()));
}

SceneFile scene_to_run(const RunOptions& options) {
  check_methods(options.settings);
  check_threads(options.threads);
  SceneFile file = read_scene(find_scene(options.scene), options.settings);
  file.settings.threads = options.threads;
  return file;
}

SceneFile scene_to_run(const RunOptions& options, const SceneFile& file) {
  check_methods(options.settings);
  SceneFile changed = with_settings(file, options.settings);
  changed.settings.threads = options.threads;
  return changed;
}

void print_remark(const SceneFile& file, std::ostream& err) {
  if (!file.remark.empty()) err << "taut: " << file.remark << '\n';
}

RunPlan make_plan(const RunOptions& options) {
  RunPlan plan;
  SceneFile& file = plan.file;
  file = scene_to_run(options);
  plan.file_checksum = file_checksum(file);
  file.drawing = with_options(file.drawing, options.drawing);
  apply_scene(file.drawing, file);
  file.drawing.frames = frame_count(options, file);
  file.history = history_interval(options, file);
  if (options.out && options.out->empty()) throw UsageError("--out is empty; name a folder");
  plan.folder = options.out ? RunFolder(*options.out, options.out_named)
                            : RunFolder(default_folder(file), /*named=*/false);
  refuse_second_columns(file);
  for (const std::string& remark :
       {no_use(options), lines_without_samples(file.scene),
        warning_about_reactions(file.scene, *find_method(file.settings.method), file.settings)})
    if (!remark.empty()) file.remark += (file.remark.empty() ? "" : "; ") + remark;
  plan.requested_spacing = file.requested_spacing;
  plan.checkpoint_every = options.checkpoint_every;
  plan.keep_checkpoint = options.keep_checkpoint;
  if (!options.no_render) plan.drawing = file.drawing;
  plan.keeps_look = options.keeps_look;
  if (options.look && plan.drawing) {
    set_open(*plan.drawing, *options.look);
    file.drawing.look.range = plan.drawing->look.range;
    if (file.scene.dim == 2) file.drawing.look.view = plan.drawing->look.view;  // 3D scenes have no view
  }
  plan.particle_fields = particle_fields(options, file.scene.dim);
  plan.particle_form = particle_form(options);
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
