#pragma once

#include <optional>

#include "engine/diagnostics/balance.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Greatest relative drift of the sums that a closed system keeps, less the impulses of walls; none where the scene
/// exchanges the quantity with its surroundings.
struct Conservation {
  std::optional<double> linear_momentum;   // |Δp| over the greatest Σ|m v|
  std::optional<double> angular_momentum;  // |ΔL| over the greatest Σ m|x||v|
  /// Greatest |E + D − W − E0| over the greatest E0 + W, where W is the work of drives, loads and gravity and D the
  /// energy dissipated by the scene's damping; none in a scene without energy but round-off.
  std::optional<double> energy;
  /// The same with its sign: the greatest increase and the greatest decrease, both ≥ 0.
  std::optional<double> energy_gained, energy_lost;
};

/// Something acts from outside with momentum that nobody counts: held or driven particles, loads, gravity or
/// damping.
bool exchanges_momentum(const Scene& scene, const Snapshot& start);

/// Follows the sums of a run from one time to the next.
class ConservationWatch {
 public:
  ConservationWatch(const Scene& scene, const Snapshot& start)
      : exchanges_momentum_(exchanges_momentum(scene, start)), nothing_(energy_of_rounding(scene, start)) {}

  /// The first sums are what the others drift from.
  void follow(const Balance& now);
  Conservation so_far() const;

  /// What it has seen so far; the rest comes from the start.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, linear_, angular_, gained_, lost_, linear_scale_, angular_scale_, energy_scale_);
  }

 private:
  bool exchanges_momentum_;
  double nothing_;  // of energies, J
  std::optional<Balance> start_;
  double linear_ = 0, angular_ = 0;  // greatest |change|
  double gained_ = 0, lost_ = 0;     // of the energy, J
  double linear_scale_ = 0, angular_scale_ = 0, energy_scale_ = 0;
};

}  // namespace taut
