#include "cli/run/labels.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"
#include "render/page/ticks.hpp"

namespace taut::cli {
namespace {

struct Remark {
  std::string name, text;
  bool operator==(const Remark&) const = default;
};

std::string spacing_text(double spacing) {
  const render::Scale scale = render::scale_for(spacing, "m");
  return fmt::format("dp = {} {}", brief(spacing * scale.factor), scale.unit);
}

std::string short_number(const std::string& value) {
  const auto number = parsed<double>(value);
  return number ? brief(*number) : value;
}

void add_settings(std::vector<Remark>& remarks, const SceneFile& file) {
  const auto changed = [](const ResolvedSetting& s) { return s.value != s.default_value; };
  for (const ResolvedSetting& each : file.resolved)
    if (each.name.starts_with(constant_prefix) && changed(each)) {
      const std::string constant = each.name.substr(constant_prefix.size());
      remarks.push_back({constant, fmt::format("{} = {}", constant, short_number(each.value))});
    }
  const std::string_view own_contact = name(find_method(file.settings.method)->contact);
  for (const SettingInfo& info : setting_infos()) {
    const ResolvedSetting& each = *file.find_resolved(info.name);
    if (!info.label.empty() && changed(each) && !(info.name == "contact" && each.value == own_contact))
      remarks.push_back({each.name, fmt::format(fmt::runtime(info.label), short_number(each.value))});
  }
}

std::vector<Remark> remarks_on(const SceneFile& file) {
  std::vector<Remark> remarks{{"scene", file.scene.title}, {"method", file.settings.method}};
  for (const Parameter& p : file.parameters)
    remarks.push_back({p.name, fmt::format("{} = {}{}", p.name, brief(p.value),
                                           p.unit.empty() || p.unit == "1" ? "" : " " + p.unit)});
  remarks.push_back({"spacing", spacing_text(file.scene.spacing)});
  if (const Jitter& jitter = file.scene.jitter; jitter.share > 0)
    remarks.push_back(
        {"jitter", fmt::format("jittered by {} dp{}", brief(jitter.share),
                               jitter.seed == 1 ? "" : ", seed " + std::to_string(jitter.seed))});
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
    labels.push_back(
        fmt::format("t = {} {}", render::format_fixed(time * scale.factor, decimals), scale.unit));
  return labels;
}

}  // namespace taut::cli
