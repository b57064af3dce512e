#include "cli/run/lines_file.hpp"

#include <algorithm>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

/// What the measures of a line compare it with.
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

LineSamplesFile::LineSamplesFile(const std::filesystem::path& path, const Scene& scene,
                                 const std::string& law, AppendFile::Start start)
    : file_(path, start) {
  if (start == AppendFile::Start::empty) file_.append("line,t,step,x,y,value,reference");
  for (const SampleLine& line : scene.lines) lines_.push_back({line, reference_of(line, scene, law)});
}

void LineSamplesFile::add(const std::vector<std::vector<LineSample>>& samples) {
  for (std::size_t l = 0; l < lines_.size(); ++l)
    for (std::size_t& k = lines_[l].written; k < samples[l].size(); ++k) add(lines_[l], samples[l][k]);
}

void LineSamplesFile::add(const Known& known, const LineSample& sample) {
  for (int k = 0; k < known.line.points; ++k) {
    const Point at = line_point(known.line, k);
    std::string row = known.line.name + "," + exact(sample.time) + "," + std::to_string(sample.step) + "," +
                      exact(at[0]) + "," + exact(at[1]) + "," +
                      exact(sample.value[static_cast<std::size_t>(k)]) + ",";
    if (known.reference) row += exact(known.reference(at, sample.time));
    file_.append(row);
  }
}

}  // namespace taut::cli
