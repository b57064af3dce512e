#include "cli/run/panel_cells.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "render/page/ticks.hpp"

namespace taut::cli {
namespace {

/// Why a run has no particles later than its last ones.
std::string ending(const SavedRun& run, double until) {
  std::ifstream file(run.folder.record());
  const auto record = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  const bool failed = record.is_object() && record.value("status", "") == "failed";
  const double last = failed && record.contains("reached") && record["reached"].is_number()
                          ? record["reached"].get<double>()
                          : run.particles.back().time();
  return (failed ? "diverged at " : "ended at ") + render::format_time(last, until);
}

}  // namespace

PanelCell cell_at(const SavedRun& run, double time, double until, const Field& field) {
  const auto distance = [time](const ParticleFile& file) { return std::abs(file.time() - time); };
  const auto nearest = std::ranges::min_element(run.particles, {}, distance);
  const double interval = run.file.scene.until / run.file.drawing.frames;
  if (time > run.particles.back().time() + 0.75 * interval) return {std::nullopt, ending(run, until)};
  constexpr double noticeable = 0.002;  // of the whole time
  return {read_colored(*nearest, field, run.file.scene.dim),
          distance(*nearest) > noticeable * until ? render::format_time(nearest->time(), until) : ""};
}

}  // namespace taut::cli
