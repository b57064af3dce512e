#include "cli/run/labels.hpp"

#include <algorithm>
#include <cmath>

#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"
#include "render/page/ticks.hpp"

namespace taut::cli {
namespace {

/// Property of a run, comparable by `name`.
struct Remark {
  std::string name, text;
  bool operator==(const Remark&) const = default;
};

std::string spacing_text(double spacing) {
  const render::Scale scale = render::scale_for(spacing, "m");
  return "dp = " + brief(spacing * scale.factor) + " " + scale.unit;
}

void add_settings(std::vector<Remark>& remarks, const SceneFile& file) {
  const MethodInfo& method = *find_method(file.settings.method);
  for (const MethodConstant& constant : method_constants(method.formulation, file.scene.dim)) {
    const auto given = file.settings.constants.find(std::string(constant.name));
    if (given != file.settings.constants.end() && given->second != constant.value)
      remarks.push_back({given->first, given->first + " = " + brief(given->second)});
  }
  if (file.settings.cfl > 0 && file.settings.cfl != method.cfl)
    remarks.push_back({"cfl", "CFL " + brief(file.settings.cfl)});
  if (!method.laws.empty() && file.settings.law != method.laws.front().name)
    remarks.push_back({"law", "law " + file.settings.law});
  if (file.settings.stepping == Stepping::single) remarks.push_back({"stepping", "single stepping"});
  if (file.scene.contact != ContactLaw::published && file.scene.contact != method.contact)
    remarks.push_back({"contact", "contact " + std::string(name(file.scene.contact))});
}

std::vector<Remark> remarks_on(const SceneFile& file) {
  std::vector<Remark> remarks{{"scene", file.scene.title}, {"method", file.settings.method}};
  for (const Parameter& p : file.parameters)
    remarks.push_back(
        {p.name, p.name + " = " + brief(p.value) + (p.unit.empty() || p.unit == "1" ? "" : " " + p.unit)});
  remarks.push_back({"spacing", spacing_text(file.scene.spacing)});
  if (const Jitter& jitter = file.scene.jitter; jitter.share > 0)
    remarks.push_back({"jitter", "jittered by " + brief(jitter.share) + " dp" +
                                     (jitter.seed == 1 ? "" : ", seed " + std::to_string(jitter.seed))});
  add_settings(remarks, file);
  return remarks;
}

bool all_say(const std::vector<std::vector<Remark>>& runs, const Remark& remark) {
  return std::ranges::all_of(runs,
                             [&](const auto& remarks) { return std::ranges::count(remarks, remark) > 0; });
}

render::Heading heading_of(const std::vector<std::string>& texts, const SavedRun& run) {
  if (texts.empty()) return {(run.folder.path() / "").parent_path().filename().string(), ""};
  return {texts.front(), join({texts.begin() + 1, texts.end()})};
}

}  // namespace

RunLabels label_runs(const std::vector<SavedRun>& runs) {
  std::vector<std::vector<Remark>> remarks;
  for (const SavedRun& run : runs) remarks.push_back(remarks_on(run.file));
  RunLabels labels;
  const Remark &scene = remarks[0][0], &method = remarks[0][1];
  if (all_say(remarks, scene)) labels.title = scene.text;
  if (all_say(remarks, method)) labels.note = method.text;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::vector<std::string> texts;
    for (const Remark& remark : remarks[k])
      if (!all_say(remarks, remark)) texts.push_back(remark.text);
    labels.columns.push_back(heading_of(texts, runs[k]));
  }
  return labels;
}

std::vector<std::string> time_labels(const std::vector<double>& times, double until) {
  constexpr int most_decimals = 4;
  const render::Scale scale = render::scale_for(until, "s");
  int decimals = 0;
  const auto exact_with = [&](double time) {
    const double shift = std::pow(10.0, decimals);
    return std::abs(std::round(time * scale.factor * shift) / shift - time * scale.factor) <
           1e-9 * until * scale.factor;
  };
  while (decimals < most_decimals && !std::ranges::all_of(times, exact_with)) ++decimals;
  std::vector<std::string> labels;
  for (const double time : times)
    labels.push_back("t = " + render::format_fixed(time * scale.factor, decimals) + " " + scale.unit);
  return labels;
}

}  // namespace taut::cli
