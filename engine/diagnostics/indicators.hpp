#pragma once

#include <array>
#include <string_view>

#include "engine/diagnostics/alternating_part.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Measure of failure: `part` of a `whole`.
struct Indicator {
  std::string_view key;
  std::string_view part, whole;
};

inline constexpr std::array indicators = {
    Indicator{"hourglass_error", "rms displacement that alternates from particle to particle", "spacing"},
    Indicator{"pressure_checkerboard", "rms pressure that alternates", "rms pressure"},
    Indicator{"von_mises_checkerboard", "rms von Mises stress of the deviatoric stress that alternates",
              "rms von Mises stress"},
};

struct Reading {
  double part = 0, whole = 0;  // same unit
  int particle = -1;           // centre of the worst patch; −1: a whole body is worse
  double share() const { return part == 0 ? 0 : part / whole; }
};
using Readings = std::array<Reading, indicators.size()>;

struct IndicatorRecord {
  double greatest_part = 0, greatest_whole = 0;
  double at = 0;       // s
  long particle = -1;  // see Reading
  double last = 0;     // share
  /// Relative to the greatest whole: noise in unloaded bodies counts little.
  double greatest() const { return Reading{greatest_part, greatest_whole}.share(); }
  void take(const Reading& now, double time);
};

/// Alternating parts r(q)_i of fields (AlternatingPart); rms over particles with a row.
/// - hourglass_error: rms |r(x)| / dp of the worst body, or 0.2 times the value of the worst patch, if that is
/// greater. A patch is a particle and the particles of its row. A zigzag of amplitude a gives a/dp.
/// |r(x)| = |Σ_j w_ij E_ij| with the error vectors E_ij = F_i X_ij − x_ij of [Ganzenmueller2015], for any F_i.
/// Particles count at most one spacing, since displacements at cracks mean nothing. Departure: the mean |½ (E_ij −
/// E_ji)| / |X_ij| of the paper includes smooth fields where F is one-sided.
/// - pressure_checkerboard = rms r(p) / rms p.
/// - von_mises_checkerboard = rms √(3/2 r(s):r(s)) / rms √(3/2 s:s), since von Mises stress has kinks.
/// For the last two a pure checkerboard gives 1, noise 0.59 (3D: 0.73). Denominators are at least 1e-8 E, the
/// round-off of Young's modulus E. [Ganzenmueller2015]: see METHODS.md.
class IndicatorGauge {
 public:
  IndicatorGauge(const Scene& scene, const Snapshot& start, int threads = 1);
  Readings operator()(const Snapshot& now) const;

 private:
  Reading hourglass(const std::vector<double>& squared) const;

  AlternatingPart part_;
  std::vector<int> row_of_;  // [particle] −1: none
  std::vector<int>
      first_row_;       // [body] and one past the last; bodies at the end without rows are left out
  double spacing_ = 0;  // m
  double least_stress_ = 0;  // Pa
};

}  // namespace taut
