#pragma once

#include <optional>

#include "engine/diagnostics/balance.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Greatest relative drifts, corrected for walls; no momenta if exchanges_momentum.
struct Conservation {
  std::optional<double> linear_momentum;   // |Δp| over greatest Σ|m v|
  std::optional<double> angular_momentum;  // |ΔL| over greatest Σ m|x||v|
  /// Greatest |E + D − W − E0| over greatest E0 + W; W: external work, D: damped energy. None if energies are only
  /// round-off.
  std::optional<double> energy;
  std::optional<double> energy_gained, energy_lost;
};

/// Whether external actions other than walls change the momentum.
bool exchanges_momentum(const Scene& scene, const Snapshot& start);

class ConservationWatch {
 public:
  ConservationWatch(const Scene& scene, const Snapshot& start)
      : exchanges_momentum_(exchanges_momentum(scene, start)), nothing_(energy_of_rounding(scene, start)) {}

  void follow(const Balance& now);
  Conservation so_far() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, linear_, angular_, gained_, lost_, linear_scale_, angular_scale_, energy_scale_);
  }

 private:
  bool exchanges_momentum_;
  double nothing_;  // round-off, J
  std::optional<Balance> start_;
  double linear_ = 0, angular_ = 0;  // greatest |change|
  double gained_ = 0, lost_ = 0;     // J
  double linear_scale_ = 0, angular_scale_ = 0, energy_scale_ = 0;
};

}  // namespace taut
