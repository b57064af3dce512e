#pragma once

#include <array>
#include <string_view>

#include "engine/diagnostics/alternating_part.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// A number that says how far a run has gone where a method fails: `part` of a `whole`.
struct Indicator {
  std::string_view key;  // in history.csv and run.json
  std::string_view part, whole;
};

inline constexpr std::array indicators = {
    Indicator{"hourglass_error", "rms displacement that alternates from particle to particle", "spacing"},
    Indicator{"pressure_checkerboard", "rms pressure that alternates", "rms pressure"},
    Indicator{"von_mises_checkerboard", "rms von Mises stress of the deviatoric stress that alternates",
              "rms von Mises stress"},
};

/// An indicator at one time.
struct Reading {
  double part = 0, whole = 0;  // of one unit, see Indicator
  int particle = -1;           // in the middle of the worst patch; −1: a body as a whole is worse
  /// 0 where there is nothing.
  double share() const { return part == 0 ? 0 : part / whole; }
};
/// One for each of `indicators`, in their order.
using Readings = std::array<Reading, indicators.size()>;

/// What a run shows of one indicator.
struct IndicatorRecord {
  double greatest_part = 0, greatest_whole = 0;
  double at = 0;      // s, of the greatest part
  long particle = -1;  // see Reading
  double last = 0;     // share
  /// The greatest part over the greatest whole of the run, as the eye sees it where all frames share one
  /// range of colours: the noise of a body that has sprung back counts for what it is, not for all there is.
  double greatest() const { return Reading{greatest_part, greatest_whole}.share(); }
  void take(const Reading& now, double time);
};

/// Measures the indicators of a state. All come from the part of a field that alternates from particle to
/// particle, r(q)_i = Σ_j w_ij q_j of AlternatingPart, to which smooth fields, curved or at a surface, add
/// next to nothing; rms is the root of the mean square over the particles that have such a row.
///
/// hourglass_error = rms |r(x)| / dp, the greatest of all bodies, or 0.3 times the greatest of all patches: of a particle and
///   the particles in its row. Bodies without zigzags thus do not hide one, and neither do smooth parts. By Σ_j w_ij = 0 and Σ_j w_ij X_ij = 0 that is rms |Σ_j w_ij E_ij| / dp
///   with the error vectors E_ij = F_i X_ij − x_ij of [Ganzenmueller2015], whatever F_i is. A zigzag of
///   amplitude a gives a/dp; rigid motion and every quadratic map give 0. A particle counts with one spacing
///   at most: beyond that its place among those that were its neighbours is lost, as it is beside a crack,
///   and how far they are now means nothing.
///   Differs from the paper, whose scalar is the mean of |½ (E_ij − E_ji)| / |X_ij| over the neighbours:
///   there a smooth field counts too, where F is one-sided; here the weights leave what exceeds a smooth
///   field.
/// pressure_checkerboard = rms r(p) / rms p.
/// von_mises_checkerboard = rms √(3/2 r(s):r(s)) / rms √(3/2 s:s): of the components, which are smooth where
///   the von Mises stress has a kink (the neutral line of a bent beam) and differ where it hides their sign.
/// The last two are shares: 1 for a pure checkerboard, ε/√(1 + ε²) for one of ε times the rms of a smooth
/// background, 0.59 (3D: 0.73) for noise. The whole is at least 1e-8 of Young's modulus, so that round-off in
/// a body without stress is no checkerboard.
///
/// [Ganzenmueller2015] G. C. Ganzenmüller: An hourglass control algorithm for Lagrangian smooth particle
/// hydrodynamics. Computer Methods in Applied Mechanics and Engineering 286 (2015) 87–106.
class IndicatorGauge {
 public:
  IndicatorGauge(const Scene& scene, const Snapshot& start, int threads = 1);
  Readings operator()(const Snapshot& now) const;

 private:
  Reading hourglass(const std::vector<double>& squared) const;

  AlternatingPart part_;
  std::vector<int> row_of_;  // [particle] −1: none
  std::vector<int>
      first_row_;       // [body] and one past the last of all; bodies at the end without rows are left out
  double spacing_ = 0;  // m
  double least_stress_ = 0;  // Pa
};

}  // namespace taut
