#pragma once

#include <optional>

#include "engine/diagnostics/balance.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Greatest relative drift of what a closed system keeps, the impulses of walls taken off; none where it says
/// nothing.
struct Conservation {
  std::optional<double>
      linear_momentum;  // |Δp| over the greatest Σ|m v|; none where something acts from outside
  std::optional<double> angular_momentum;  // |ΔL| over the greatest Σ m|x||v|; none there either
  /// Greatest |E + D − W − E0| over the greatest E0 + W, W the work of drives, loads and gravity, D what the
  /// scene's damping has taken; none when there is no energy.
  std::optional<double> energy;
};

/// Follows the sums of a run from one look to the next.
class Drift {
 public:
  void look(const Balance& now);
  /// `exchanges_momentum`: there are held or driven particles, loads, gravity or damping.
  Conservation conservation(bool exchanges_momentum) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start_, linear_, angular_, energy_, linear_scale_, angular_scale_, energy_scale_);
  }

 private:
  std::optional<Balance> start_;
  double linear_ = 0, angular_ = 0, energy_ = 0;  // greatest |change|
  double linear_scale_ = 0, angular_scale_ = 0, energy_scale_ = 0;
};

}  // namespace taut
