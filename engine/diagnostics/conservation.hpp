#pragma once

#include <optional>

#include "engine/diagnostics/balance.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Greatest relative drift of conserved sums, corrected for the impulses of walls; none if the scene exchanges the
/// quantity with its surroundings.
struct Conservation {
  std::optional<double> linear_momentum;   // |Δp| / greatest Σ|m v|
  std::optional<double> angular_momentum;  // |ΔL| / greatest Σ m|x||v|
  /// Greatest |E + D − W − E0| / greatest E0 + W, with work W of drives, loads and gravity, and energy D removed by
  /// damping. None if the energy is only round-off.
  std::optional<double> energy;
  /// Greatest increase and greatest decrease of energy, both ≥ 0.
  std::optional<double> energy_gained, energy_lost;
};

/// The scene changes momentum without record: by clamps, guides, drives, loads, gravity or damping.
bool exchanges_momentum(const Scene& scene, const Snapshot& start);

/// Tracks the conserved sums of a run.
class ConservationWatch {
 public:
  ConservationWatch(const Scene& scene, const Snapshot& start)
      : exchanges_momentum_(exchanges_momentum(scene, start)), nothing_(energy_of_rounding(scene, start)) {}

  /// The first call sets the reference for drifts.
  void follow(const Balance& now);
  Conservation so_far() const;

  /// Archives what was observed; the rest follows from the start.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, linear_, angular_, gained_, lost_, linear_scale_, angular_scale_, energy_scale_);
  }

 private:
  bool exchanges_momentum_;
  double nothing_;  // round-off energy, J
  std::optional<Balance> start_;
  double linear_ = 0, angular_ = 0;  // greatest |change|
  double gained_ = 0, lost_ = 0;     // of energy, J
  double linear_scale_ = 0, angular_scale_ = 0, energy_scale_ = 0;
};

}  // namespace taut
