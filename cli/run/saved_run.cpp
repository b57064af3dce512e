#include "cli/run/saved_run.hpp"

#include <algorithm>
#include <iterator>

#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {

SavedRun open_saved_run(const fs::path& path) {
  const RunFolder folder(path);
  std::error_code error;
  if (!fs::exists(folder.scene(), error))
    throw UsageError("'" + path.string() +
                     "' is not a run folder; name a folder that `taut run` has written");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.particles(), error))
    if (entry.path().extension() == ".vtp") files.push_back(entry.path());
  if (files.empty())
    throw UsageError("'" + path.string() + "' contains no saved particles; save them with\n  taut run " +
                     folder.scene().string() + " --save-particles --out " + path.string());
  // five or more digits: shorter is earlier
  std::ranges::sort(files, {},
                    [](const fs::path& file) { return std::pair(file.string().size(), file.string()); });
  SavedRun run{folder, read_scene(folder.scene()), {}};
  for (const fs::path& file : files) run.particles.emplace_back(file);
  return run;
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
    throw UsageError("the particle file does not belong to the scene: it has " + std::to_string(file.size()) +
                     " particles, but the scene has " + std::to_string(origins.size()));
  const ColorFormula& formula = drawing.of_formula;
  std::vector<std::vector<double>> values;
  std::ranges::transform(formula.fields, std::back_inserter(values), values_of);
  read.value = formula.values(values, read.dim, read.x, origins.x0, read.time);
  return read;
}

}  // namespace taut::cli
