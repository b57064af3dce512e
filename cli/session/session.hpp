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
#include "render/image/image.hpp"

namespace taut::cli {

/// A simulation that goes on and is looked at as commands say. Every member throws UsageError for what cannot
/// be, and then has changed nothing.
class Session {
 public:
  /// Throws SceneError too.
  explicit Session(const RunOptions& options);

  const SceneFile& file() const { return file_; }
  const Simulation& simulation() const { return *simulation_; }

  /// Both stop early when interrupted. NumericalError where the simulation diverges.
  void step(long count, const Interrupts& interrupts);
  /// To the first step at or past `t`; what is shown then is of `t` itself.
  void run_until(double t, const Interrupts& interrupts, Progress& progress);

  /// The particles as pictures show them.
  const Snapshot& shown() const { return between_ ? *between_ : simulation_->snapshot(); }

  /// What may change while a simulation runs: the step size (cfl) and the method's constants
  /// that no geometry of the start was made from.
  void set(const Setting& setting);
  /// The names that `set` takes.
  std::vector<std::string> names_to_change() const;

  /// A key of drawing, as typed.
  void set_look(const DrawingKey& key, const std::string& text);
  /// Moves what is seen, m.
  void pan(double dx, double dy);
  /// Shows less of it, larger, about its centre; `factor` > 0, below 1: more.
  void zoom(double factor);
  /// The camera of a scene in 3D goes about what it looks at, degrees.
  void orbit(double right, double upwards);
  /// How a frame looks now, with what is automatic as it suits this moment.
  Drawing drawing() const;
  /// As a frame of `run` at this time would be.
  void frame(const std::filesystem::path& file) const;
  /// The same as a picture, with the look of this drawing, in which nothing is open.
  render::Image picture(const Drawing& drawing) const;

  void save(const std::filesystem::path& file) const;
  /// A state of the same scene and method, which `save` left.
  void load(const std::filesystem::path& file);

 private:
  void see(const render::View& view);

  RunOptions options_;
  SceneFile file_;
  Drawing drawing_;
  std::optional<render::View> window_;  // of a scene in 3D, where pan and zoom have been
  std::unique_ptr<Simulation> simulation_;
  std::optional<Snapshot> between_;  // of a time in the last step, where it was asked for
};

}  // namespace taut::cli
