#include "cli/study/choose.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <ostream>
#include <stdexcept>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/picture_options.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/sections.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

struct ChooseArguments : ReportOptions {
  std::string scene, measure, against;
  std::vector<Setting> settings;
  std::optional<std::string> error;
  std::optional<double> seconds;
  std::vector<std::string> from;
};

double share(const std::string& text) {
  const bool percents = text.ends_with('%');
  const auto value = parsed<double>(std::string_view(text).substr(0, text.size() - (percents ? 1 : 0)));
  if (!value || !(*value > 0))
    throw UsageError(fmt::format("--error is '{}'; it must be a number above 0, such as 1% or 0.01", text));
  return percents ? *value / 100 : *value;
}

/// results.csv files of `scene`, at most three levels below out/.
std::vector<std::string> stored_results(const std::string& scene) {
  constexpr int deepest = 3;
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry("out", error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry.depth() >= deepest) entry.disable_recursion_pending();
    if (entry->path().filename() != "results.csv") continue;
    try {
      if (read_results({entry->path().string()}).scene == scene) files.push_back(entry->path().string());
    } catch (const UsageError&) {
      // not a sweep, or no result yet
    }
  }
  if (files.empty())
    throw UsageError(
        fmt::format("there are no results of {} within three levels of folders below out/; "
                    "make some with `taut sweep`, or name others with --from",
                    scene));
  std::ranges::sort(files);
  return files;
}

bool is_same(const std::string& a, const std::string& b) {
  const auto x = parsed<double>(a), y = parsed<double>(b);
  return x && y ? std::abs(*x - *y) <= 1e-9 * std::abs(*y) : a == b;
}

/// Value of a run; empty if unknown.
std::string value_in(const StoredRun& run, const std::string& name) {
  const RunRecord& record = run.record;
  if (name == "method") return run.method();
  if (name == "spacing") return run.text("spacing");  // fitted to the first body
  if (name == "contact") return record.contact.value_or("");
  return name == "law" && !record.material_law.empty() ? law_name(record.material_law) : value_of(run, name);
}

/// Settings of the runs that `choose` accepts.
class WantedSettings {
 public:
  WantedSettings(SceneFile file, std::vector<Setting> settings)
      : file_(std::move(file)), settings_(std::move(settings)) {}

  /// Parameters, `until`, law, and names of --set.
  std::vector<std::string> names() const {
    std::vector<std::string> all = names_of(file_.parameters);
    all.insert(all.end(), {"until", "law"});
    for (const Setting& setting : settings_) all.push_back(setting.name);
    return all;
  }

  /// Empty if the scene has no such name.
  std::string value(const std::string& name) const { return resolved(file_, name); }

  std::string value_for(const StoredRun& run, const std::string& name) {
    if (name == "spacing") return exact(file_.scene.spacing);
    const SceneFile& file = scene_at_spacing_of(run);
    const MethodInfo* const method = find_method(run.method());
    if (name == "law" && method && !is_set(name) &&
        !reason_against_law(*method, resolved(file, name)).empty())
      return law_name(material_law(*method, {}, file.scene.dim));  // such methods run with their own law
    if (name == "contact" && method) try {
        return std::string(taut::name(contact_law(file.scene, *method)));
      } catch (const SceneError&) {
        // no run of the method has this contact law
      }
    return resolved(file, name);
  }

  bool excludes(const StoredRun& run, const std::string& name) {
    const std::string value = value_in(run, name), wanted = value_for(run, name);
    return !value.empty() && !wanted.empty() && !is_same(value, wanted);
  }

 private:
  static std::string resolved(const SceneFile& file, const std::string& name) {
    const ResolvedSetting* found = file.find_resolved(name);
    if (!found) return "";
    return name == "law" && found->value.empty() ? "neo-hookean" : found->value;
  }

  bool is_set(const std::string& name) const {
    return std::ranges::find(settings_, name, &Setting::name) != settings_.end();
  }

  /// Parameters and `until` can depend on the spacing.
  const SceneFile& scene_at_spacing_of(const StoredRun& run) {
    const double spacing = run.record.requested_spacing.value_or(run.record.spacing);
    std::error_code error;
    if (!(spacing > 0) || !fs::is_regular_file(file_.path, error)) return file_;  // a pipe is read once
    const auto [found, fresh] = scenes_.try_emplace(spacing, file_);
    if (fresh) try {
        std::vector<Setting> settings = settings_;
        settings.push_back({"spacing", exact(spacing)});
        found->second = read_scene(file_.path, settings);
      } catch (const std::runtime_error&) {
        // the scene does not allow this spacing
      }
    return found->second;
  }

  SceneFile file_;
  std::vector<Setting> settings_;
  std::map<double, SceneFile> scenes_;  // by requested spacing, m
};

/// Removes runs with other settings. Returns the settings that excluded runs.
std::string keep_matching_runs(WantedSettings& settings, StoredResults& results) {
  std::vector<std::string> names = names_of_scene(results.runs), others;
  for (const std::string& name : settings.names())
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  for (const std::string& name : names)
    if (std::erase_if(results.runs, [&](const StoredRun& run) { return settings.excludes(run, name); }) > 0)
      others.push_back(fmt::format("{} = {}", name, settings.value(name)));
  return join(others);
}

ChartRequest request(const ChooseArguments& options, const SceneFile& file, WantedSettings& settings) {
  ChartRequest request{options.measure, Cost::wall};
  if (options.against.empty() || find_method(options.against)) {
    request.against = options.against;
    return request;
  }
  StoredResults one;
  one.runs.push_back(read_stored_run(options.against));
  if (const std::string scene = one.runs.front().record.scene; scene != file.scene.name)
    throw UsageError(
        fmt::format("'{}' is a run of {}; it must be of {}", options.against, scene, file.scene.name));
  request.run = one.runs.front();
  std::vector<std::string> names = names_of(file.parameters);
  names.insert(names.end(), {"until", "law", "jitter"});
  for (const std::string& name : names)
    if (settings.excludes(*request.run, name))
      throw UsageError(fmt::format("the run in '{}' has {} = {}, not {}; choose this value with --set",
                                   options.against, name, value_in(*request.run, name),
                                   settings.value_for(*request.run, name)));
  if (!one.runs.front().is_stable())
    throw UsageError(fmt::format("the run in '{}' has the verdict {}; a reference must be stable",
                                 options.against, one.runs.front().verdict()));
  return request;
}

Json json(const Chart& chart, const ChoiceLimits* limits, std::optional<double> seconds,
          const std::vector<Offer>& offers) {
  Json answer = json_answer("choose");
  answer["scene"] = chart.scene;
  answer["measure"] = chart.measure;
  answer["unit"] = chart.unit.empty() ? Json() : Json(chart.unit);
  answer["error"] = limits ? Json(limits->error) : Json();
  answer["seconds"] = seconds;
  answer["granted"] = !offers.empty();
  answer["runs"] = to_json(offers);
  answer["references"] = chart.references;
  answer["machines"] = chart.machines;
  return answer;
}

int choose(const ChooseArguments& options, Streams streams) {
  std::optional<double> error;
  if (options.error) error = share(*options.error);
  const SceneFile file = read_scene(find_scene(options.scene), options.settings);
  const std::string& scene = file.scene.name;
  const std::vector<std::string> files = options.from.empty() ? stored_results(scene) : options.from;
  StoredResults results = read_results(files);
  if (results.scene != scene)
    throw UsageError(fmt::format("the results are of scene {}; they must be of {}", results.scene, scene));
  WantedSettings settings(file, options.settings);
  const std::string wanted = keep_matching_runs(settings, results);
  if (std::ranges::none_of(results.runs, &StoredRun::has_result))
    throw UsageError(fmt::format(
        "no run in {} has the values of the scene, {}; choose other values with --set", join(files), wanted));
  if (!wanted.empty())
    streams.err << "taut: only runs with " << wanted << " are used; choose other values with --set\n";
  const Chart chart = make_chart(results, request(options, file, settings));
  if (error && !chart.unit.empty() && options.error->ends_with('%'))
    throw UsageError(
        fmt::format("the errors of {0} have the unit {1} and cannot be given in %; give --error in {1}",
                    chart.measure, chart.unit));
  if (error && chart.unit.empty() && *error >= 1 && !options.error->ends_with('%'))
    streams.err << "taut: --error " << *options.error << " allows an error of " << brief(100 * *error)
                << " %; write " << *options.error << "% for " << *options.error << " %\n";
  const ChoiceLimits limits{error.value_or(0), options.seconds};
  const std::vector<Offer> offers =
      error ? suitable_offers(chart, limits) : pareto_front(chart, options.seconds);
  if (options.json)
    streams.out << json(chart, error ? &limits : nullptr, options.seconds, offers).dump(2) << '\n';
  else
    streams.out << (error ? advice(chart, limits) : price_list(chart, options.seconds))
                << "Results: " << join(files) << '\n';
  return offers.empty() ? exit_not_granted : exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_choose(Options& command) {
  auto options = std::make_shared<ChooseArguments>();
  command.add_argument("SCENE", options->scene, "a name from `taut list scenes`, or the path of a scene file")
      .required();
  command.add("--error", "X", options->error,
              "largest acceptable error, such as 1% or 0.01; default: list the cost of each accuracy");
  command
      .add(
          "--set", "NAME=VALUE",
          [options](const std::vector<std::string>& assignments) {
            for (const std::string& text : assignments) options->settings.push_back(parse_setting(text));
          },
          "value of a parameter or setting of the scene; runs with other values are ignored")
      .one_word_each()
      .check(assignment);
  command.add("--seconds", "T", options->seconds, "largest acceptable time of solving, s; default: no limit")
      .check(positive_number);
  declare_measure(command, options->measure);
  command.add(
      "--against", "METHOD|DIR", options->against,
      "method or run folder that replaces the references of the scene; of a method, the finest stable run");
  command.add("--from", "FILE ...", options->from,
              "results.csv files of sweeps, or the folders of sweeps; "
              "default: all within three levels of folders below out/");
  options->declare_json(command);
  return [options](Streams streams) { return choose(*options, streams); };
}

}  // namespace taut::cli
