#include "cli/study/reference_curves.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/diagnostics/lines.hpp"
#include "engine/diagnostics/measure_kinds.hpp"

namespace taut::cli {

std::vector<ReferenceCurve> reference_curves(const Scene& scene, const std::string& law,
                                             std::span<const double> times) {
  std::vector<ReferenceCurve> curves;
  const auto found = scene.references.find(law);
  if (found == scene.references.end()) return curves;
  const Reference& reference = found->second;
  std::set<std::string> done;
  const auto add = [&](const Measure& measure, const std::string& probe, std::vector<double> t,
                       std::vector<double> values) {
    if (done.insert(probe).second)
      curves.push_back({probe, reference.name_for(measure.name), std::move(t), std::move(values)});
  };
  for (const Measure& measure : scene.measures) {
    const auto table = reference.table.find(measure.name);
    const bool is_curve = find_measure_kind(measure.kind)->solution;
    const auto solution = is_curve ? reference.solution.find(measure.name) : reference.solution.end();
    for (std::size_t k = 0; k < measure.probes.size(); ++k) {
      if (table != reference.table.end() && k < table->second.value.size())
        add(measure, measure.probes[k], table->second.t, table->second.value[k]);
      if (solution == reference.solution.end() || k >= solution->second.size()) continue;
      std::vector<double> values;
      for (const double t : times) values.push_back(solution->second[k](Point{}, t));
      add(measure, measure.probes[k], {times.begin(), times.end()}, std::move(values));
    }
  }
  return curves;
}

std::vector<ReferenceCurve> line_references(const Scene& scene, const std::string& law,
                                            const SampleLine& line, double t) {
  std::vector<ReferenceCurve> curves;
  const auto found = scene.references.find(law);
  if (found == scene.references.end()) return curves;
  const Reference& reference = found->second;
  for (const Measure& measure : scene.measures) {
    if (measure.line != line.name) continue;
    ReferenceCurve curve{
        line.name, reference.name_for(measure.name), {}, {}, fmt::format(", t = {} s", brief(t))};
    if (const auto table = reference.table.find(measure.name); table != reference.table.end()) {
      curve.t = table->second.t, curve.values = table->second.value.front();
    } else if (const auto solution = reference.solution.find(measure.name);
               solution != reference.solution.end()) {
      SampleLine fine = line;
      fine.points = std::max(line.points, solution_samples);
      for (int k = 0; k < fine.points; ++k) {
        curve.t.push_back(length_of(line) * k / (fine.points - 1));
        curve.values.push_back(solution->second.front()(line_point(fine, k), t));
      }
    } else {
      continue;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace taut::cli
