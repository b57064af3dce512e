#include "cli/run/saved_run.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

std::optional<int> number_of(const RunFolder& folder, const fs::path& file) {
  const std::string name = file.stem().string();
  const auto number = parsed<int>(name.substr(std::min(name.size(), name.find_first_of("0123456789"))));
  return number && file == folder.particle_file(*number) ? number : std::nullopt;
}

std::string what_is_saved(const RunFolder& folder) {
  std::error_code error;
  for (const ParticleFormat format : {ParticleFormat::xyz, ParticleFormat::csv})
    if (fs::exists(folder.particle_file(0, format), error))
      return "particles as ." + std::string(name(format)) +
             " files, which other programs read and taut does not";
  return "no saved particles";
}

}  // namespace

SavedRun open_saved_run(const fs::path& path) {
  const RunFolder folder(path);
  std::error_code error;
  if (!fs::is_regular_file(folder.scene(), error))  // a pipe would wait
    throw UsageError(
        fmt::format("'{}' is not a run folder; name a folder that `taut run` has written", path.string()));
  std::map<int, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.particles(), error))
    if (const auto number = number_of(folder, entry.path())) files[*number] = entry.path();
  if (files.empty())
    throw UsageError(fmt::format(
        "'{0}' contains {1}; save particles as .vtp files with\n  taut run {2} --save-particles --out {0}",
        path.string(), what_is_saved(folder), folder.scene().string()));
  SavedRun run{folder, read_scene(folder.scene()), {}, {}};
  for (const auto& [number, file] : files) {
    run.particles.emplace_back(file);
    run.numbers.push_back(number);
  }
  return run;
}

std::vector<std::string> missing_files(const SavedRun& run) {
  std::vector<std::string> names;
  for (int k = 0; k < run.numbers.back(); ++k)
    if (!std::ranges::binary_search(run.numbers, k))
      names.push_back(run.folder.particle_file(k).filename().string());
  return names;
}

FrameView ColoredParticles::view() const {
  FrameView frame;
  frame.dim = dim;
  frame.time = time;
  frame.x = x;
  frame.diameter = diameter;
  frame.value = value;
  return frame;
}

ColoredParticles read_colored(const ParticleFile& file, const Drawing& drawing, const Origins& origins) {
  const auto values_of = [&file](const Field* field) { return file.field(std::string(field->key)); };
  ColoredParticles read{origins.dim, file.time(), file.positions(origins.dim), file.diameter(), {}};
  if (drawing.formula.empty()) {
    read.value = values_of(drawing.field);
    return read;
  }
  if (file.size() != origins.size())
    throw UsageError(fmt::format(
        "the particle file does not belong to the scene: it has {} particles, but the scene has {}",
        file.size(), origins.size()));
  const ColorFormula& formula = drawing.of_formula;
  std::vector<std::vector<double>> values;
  std::ranges::transform(formula.fields, std::back_inserter(values), values_of);
  read.value = formula.values(values, read.dim, read.x, origins.x0, read.time);
  return read;
}

}  // namespace taut::cli
