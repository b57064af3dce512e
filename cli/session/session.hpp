#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/run/plan.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"
#include "engine/diagnostics/measures.hpp"
#include "render/image/image.hpp"

namespace taut::cli {

/// Members throw UsageError for wrong input, and then change nothing.
class Session {
 public:
  /// Also throws SceneError.
  explicit Session(const RunOptions& options);

  const SceneFile& file() const { return file_; }
  const Simulation& simulation() const { return *simulation_; }

  /// Stops at an interrupt, like `run_until`. Both throw NumericalError.
  void step(long count, const Interrupts& interrupts);
  /// Runs to the first step at or after `t`, then shows `t`.
  void run_until(double t, const Interrupts& interrupts, Progress& progress);

  std::string_view law() const;
  std::vector<MeasureResult> measures() const;

  const Snapshot& shown() const { return between_ ? *between_ : simulation_->snapshot(); }

  /// Keeps settings and drawing.
  void reset();

  /// Changes cfl, or constants that are not fixed at the start.
  void set(const Setting& setting);
  std::vector<std::string> names_to_change() const;

  void set_look(const DrawingKey& key, const std::string& text);
  /// Moves the view, m.
  void pan(double dx, double dy);
  /// `factor` > 0; below 1 shows more.
  void zoom(double factor);
  /// Orbits the 3D camera, degrees.
  void orbit(double right, double upwards);
  /// Fitted to the shown state.
  Drawing drawing() const;
  /// Writes a PNG file.
  void frame(const std::filesystem::path& file) const;
  /// Requires a drawing from `drawing()`.
  render::Image picture(const Drawing& drawing) const;

  void save(const std::filesystem::path& file) const;
  /// Requires a state with the same scene, settings and method.
  void load(const std::filesystem::path& file);

 private:
  void see(const render::View& view);

  RunOptions options_;
  SceneFile file_;
  std::string file_checksum_;
  Drawing drawing_;
  std::optional<render::View> window_;  // after pan or zoom in 3D
  std::unique_ptr<Simulation> simulation_;
  std::optional<Snapshot> between_;  // state within the last step
};

}  // namespace taut::cli
