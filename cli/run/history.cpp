#include "cli/run/history.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

Solution reference_of(const SampleLine& line, const Scene& scene, const std::string& law) {
  const auto reference = scene.references.find(law);
  if (reference == scene.references.end()) return {};
  for (const Measure& measure : scene.measures) {
    const auto solution = reference->second.solution.find(measure.name);
    if (measure.line == line.name && solution != reference->second.solution.end())
      return solution->second.front();
  }
  return {};
}

}  // namespace

std::vector<std::string> history_columns(const Scene& scene) {
  std::vector<std::string> names{"t", "step", "kinetic_energy", "strain_energy", "total_energy"};
  if (has_drives(scene) || has_loads(scene)) names.emplace_back("work");
  if (scene.damping > 0) names.emplace_back("damped");
  for (const char* x : {"x", "y", "z"})
    if (scene.dim == 3 || *x != 'z') names.push_back(std::string("momentum_") + x);
  if (scene.dim == 3)
    for (const char* x : {"x", "y", "z"}) names.push_back(std::string("angular_momentum_") + x);
  else
    names.emplace_back("angular_momentum");
  for (const Probe& probe : scene.probes) names.push_back(probe.name);
  names.emplace_back("pieces");
  for (const Indicator& indicator : indicators) names.emplace_back(indicator.key);
  return names;
}

std::string history_unit(const std::string& column, const Scene& scene) {
  const auto probe = std::ranges::find(scene.probes, column, &Probe::name);
  if (probe != scene.probes.end()) return std::string(unit_of(*probe, scene.dim));
  const std::string depth = scene.dim == 2 ? " per m" : "";
  if (column == "t") return "s";
  if (column.ends_with("_energy") || column == "work" || column == "damped") return "J" + depth;
  if (column.starts_with("momentum_")) return "kg m/s" + depth;
  return column.starts_with("angular_momentum") ? "kg m²/s" + depth : "";
}

History::History(const std::filesystem::path& path, const Scene& scene, AppendFile::Start start)
    : file_(path, start),
      dim_(scene.dim),
      works_(has_drives(scene) || has_loads(scene)),
      damps_(scene.damping > 0) {
  if (start == AppendFile::Start::empty) file_.append(join(history_columns(scene), ","));
}

void History::add(const Simulation& simulation, const Balance& balance, int pieces,
                  const Readings& readings) {
  if (simulation.steps() == last_step_) return;
  last_step_ = simulation.steps();
  std::string row = fmt::format("{},{}", exact(simulation.time()), simulation.steps());
  const auto cell = [&row](double value) { (row += ',') += exact(value); };
  cell(balance.kinetic);
  cell(balance.strain);
  cell(balance.kinetic + balance.strain);
  if (works_) cell(balance.work);
  if (damps_) cell(balance.damped);
  for (int k = 0; k < dim_; ++k) cell(balance.linear_momentum[static_cast<std::size_t>(k)]);
  for (int k = dim_ == 3 ? 0 : 2; k < 3; ++k) cell(balance.angular_momentum[static_cast<std::size_t>(k)]);
  for (const std::vector<double>& series : simulation.series().value) cell(series.back());
  (row += ',') += std::to_string(pieces);
  for (const Reading& reading : readings) cell(reading.share());
  file_.append(row);
}

LineSamplesFile::LineSamplesFile(const std::filesystem::path& path, const Scene& scene,
                                 const std::string& law, AppendFile::Start start)
    : file_(path, start), dim_(static_cast<std::size_t>(scene.dim)) {
  if (start == AppendFile::Start::empty)
    file_.append(dim_ == 3 ? "line,t,step,x,y,z,value,reference" : "line,t,step,x,y,value,reference");
  for (const SampleLine& line : scene.lines) lines_.push_back({line, reference_of(line, scene, law)});
}

void LineSamplesFile::add(const std::vector<std::vector<LineSample>>& samples) {
  for (std::size_t l = 0; l < lines_.size(); ++l)
    for (std::size_t& k = lines_[l].written; k < samples[l].size(); ++k) add(lines_[l], samples[l][k]);
}

void LineSamplesFile::add(const Known& known, const LineSample& sample) {
  for (int k = 0; k < known.line.points; ++k) {
    const Point at = line_point(known.line, k);
    std::string row = fmt::format("{},{},{}", known.line.name, exact(sample.time), sample.step);
    for (std::size_t a = 0; a < dim_; ++a) row += "," + exact(at[a]);
    row += fmt::format(",{},", exact(sample.value[static_cast<std::size_t>(k)]));
    if (known.reference) row += exact(known.reference(at, sample.time));
    file_.append(row);
  }
}

}  // namespace taut::cli
