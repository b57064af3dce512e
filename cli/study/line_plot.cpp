#include "cli/study/line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <ostream>
#include <set>

#include <fmt/core.h>

#include "cli/run/labels.hpp"
#include "cli/study/csv.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/diagnostics/lines.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Profile = std::vector<std::array<double, 2>>;                 // x, value; NaN: not drawn
using Profiles = std::map<std::string, std::map<double, Profile>>;  // by line and time
constexpr std::array<const char*, 3> coordinates = {"x", "y", "z"};

const SampleLine& line_of(const std::string& name, const Scene& scene) {
  const auto found = std::ranges::find(scene.lines, name, &SampleLine::name);
  if (found != scene.lines.end()) return *found;
  if (scene.lines.empty())
    throw UsageError(
        fmt::format("--lines is '{}', but the scene '{}' samples no [[line]]", name, scene.name));
  std::vector<std::string> names;
  for (const SampleLine& line : scene.lines) names.push_back(line.name);
  throw UsageError(unknown_name("line", name, names));
}

Profiles read_profiles(const std::filesystem::path& file, const std::string& x) {
  const CsvTable table = read_csv(file);
  const auto place_of = [&](const std::string& name) {
    const auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end())
      throw UsageError(fmt::format("'{}' has no column '{}'", file.string(), name));
    return static_cast<std::size_t>(found - table.columns.begin());
  };
  std::vector<std::size_t> axes;
  for (const char* axis : coordinates)
    if (x == axis || (x == "s" && std::ranges::find(table.columns, axis) != table.columns.end()))
      axes.push_back(place_of(axis));
  const std::size_t line = place_of("line"), t = place_of("t"), value = place_of("value");
  const auto number = [](const std::string& cell) {
    constexpr double greatest = 1e290;  // gnuplot needs room beyond an axis
    const double read = parsed<double>(cell).value_or(NAN);
    return std::abs(read) < greatest ? read : NAN;
  };
  Profiles all;
  Point first{};
  for (const auto& cells : table.rows) {
    const double time = number(cells[t]);
    if (std::isnan(time)) continue;
    Profile& profile = all[cells[line]][time];
    Point at{};
    for (std::size_t a = 0; a < axes.size(); ++a) at[a] = number(cells[axes[a]]);
    if (profile.empty()) first = at;
    const double along = x == "s" ? std::hypot(at[0] - first[0], at[1] - first[1], at[2] - first[2]) : at[0];
    profile.push_back({along, number(cells[value])});
  }
  return all;
}

/// The sample nearest to `t`, at most 0.1 % away (users round times), or nullptr.
const std::pair<const double, Profile>* sample_at(const std::map<double, Profile>& samples, double t) {
  const auto distance = [t](const auto& sample) { return std::abs(sample.first - t); };
  const auto nearest = std::ranges::min_element(samples, {}, distance);
  const bool is_drawn = nearest != samples.end() && distance(*nearest) <= 1e-3 * std::abs(t) &&
                        std::ranges::any_of(nearest->second, [](const auto& point) {
                          return std::isfinite(point[0]) && std::isfinite(point[1]);
                        });
  return is_drawn ? &*nearest : nullptr;
}

std::string missing_sample(const std::string& folder, const SampleLine& line, const std::string& time) {
  std::vector<std::string> times;
  for (const double t : line.times) times.push_back(brief(t));
  return fmt::format("'{}' has no sample of line '{}'{}; the scene samples it at {} s", folder, line.name,
                     time, join(times));
}

void add_references(HistoryPlot& plot, std::vector<ReferenceCurve> curves, const SampleLine& line) {
  for (ReferenceCurve& curve : curves) {
    for (std::size_t a = 0; a < coordinates.size(); ++a)
      if (plot.x.name == coordinates[a])
        for (double& s : curve.t) s = std::lerp(line.from[a], line.to[a], s / length_of(line));
    if (std::ranges::find(plot.references, curve) == plot.references.end())
      plot.references.push_back(std::move(curve));
  }
}

}  // namespace

std::string line_unit(const std::string& line, const Scene& scene) {
  return std::string(find_field(line_of(line, scene).field, scene.dim)->unit);
}

std::vector<std::string> line_axes(int dim) {
  std::vector<std::string> names{"s"};
  names.insert(names.end(), coordinates.begin(), coordinates.begin() + dim);
  return names;
}

HistoryPlot make_line_plot(const StoredResults& results, const std::vector<SceneFile>& scenes,
                           const LineRequest& request, std::ostream& err) {
  HistoryPlot plot;
  plot.kind = "lines", plot.title = results.title, plot.scene = results.scene;
  plot.x = request.x, plot.columns = request.lines;
  std::vector<double> times;  // of the curves
  std::vector<std::string> notes;
  for (const auto& [name, index] : named_runs(results.runs)) {
    const StoredRun& run = results.runs[index];
    const Scene& scene = scenes[index].scene;
    Profiles profiles = read_profiles(std::filesystem::path(run.folder()) / "lines.csv", request.x.name);
    std::map<double, HistoryPlot::Curve> curves;
    for (std::size_t column = 0; column < request.lines.size(); ++column) {
      const SampleLine& line = line_of(request.lines[column].name, scene);
      std::set<double> drawn;
      for (const double wanted : request.times.empty() ? line.times : request.times) {
        const auto* sample = sample_at(profiles[line.name], wanted);
        if (sample == nullptr) {
          notes.push_back(missing_sample(run.folder(), line, fmt::format(" at {} s", brief(wanted))));
          continue;
        }
        const auto& [time, profile] = *sample;
        if (!drawn.insert(time).second) continue;
        HistoryPlot::Curve& curve = curves[time];
        curve.name = name, curve.method = run.method();
        for (const auto& [x, value] : profile) {
          std::vector<double>& row = curve.rows.emplace_back(1 + request.lines.size(), NAN);
          row[0] = x, row[1 + column] = value;
        }
        add_references(plot, line_references(scene, run.text("material_law"), line, time), line);
      }
    }
    for (auto& [time, curve] : curves) {
      times.push_back(time);
      plot.curves.push_back(std::move(curve));
    }
  }
  if (plot.curves.empty()) throw UsageError(notes.front());
  for (const std::string& note : notes) err << "taut: " << note << '\n';
  const std::vector<std::string> labels = time_labels(times, *std::ranges::max_element(times));
  if (std::ranges::count(labels, labels.front()) == std::ssize(labels))
    for (HistoryColumn& column : plot.columns) column.label += " at " + labels.front();
  else
    for (std::size_t k = 0; k < times.size(); ++k) plot.curves[k].name += ", " + labels[k];
  return plot;
}

}  // namespace taut::cli
