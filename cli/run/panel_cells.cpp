#include "cli/run/panel_cells.hpp"

#include <algorithm>
#include <cmath>

#include "cli/run/record.hpp"
#include "render/page/ticks.hpp"

namespace taut::cli {
namespace {

std::string ending(const SavedRun& run, double until) {
  const std::optional<StoredRecord> record = checked_record(run.folder.record());
  const bool failed = record && record->status == RunRecord::Status::failed;
  const double last = failed && record->reached > 0 ? record->reached : run.particles.back().time();
  return (failed ? "diverged at " : "ended at ") + render::format_time(last, until);
}

}  // namespace

PanelCell cell_at(const SavedRun& run, double time, double until, const Drawing& drawing,
                  const Origins& origins) {
  const auto distance = [time](const ParticleFile& file) { return std::abs(file.time() - time); };
  const auto nearest = std::ranges::min_element(run.particles, {}, distance);
  const double interval = run.file.scene.until / run.file.drawing.frames;
  if (time > run.particles.back().time() + 0.75 * interval) return {std::nullopt, ending(run, until)};
  const std::string shown = render::format_time(nearest->time(), until);
  return {read_colored(*nearest, drawing, origins), shown == render::format_time(time, until) ? "" : shown};
}

}  // namespace taut::cli
