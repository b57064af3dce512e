#pragma once

#include <array>
#include <string_view>

#include "engine/diagnostics/alternating_part.hpp"
#include "engine/scene/scene.hpp"

namespace taut {

/// Ratio `part`/`whole`.
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
  double part = 0, whole = 0;
  int particle = -1;  // centre of the worst patch; −1: none
  double share() const { return part == 0 ? 0 : part / whole; }
};
using Readings = std::array<Reading, indicators.size()>;

struct IndicatorRecord {
  double greatest_part = 0, greatest_whole = 0;
  double at = 0;  // of the greatest part, s
  long particle = -1;
  double last = 0;  // share
  /// Relative to the greatest whole: noise in unloaded bodies counts little.
  double greatest() const { return Reading{greatest_part, greatest_whole}.share(); }
  void take(const Reading& now, double time);
};

/// hourglass_error departs from [Ganzenmueller2015] (THEORY.md).
class IndicatorGauge {
 public:
  IndicatorGauge(const Scene& scene, const Snapshot& start, int threads = 1);
  Readings operator()(const Snapshot& now) const;

 private:
  Reading hourglass(const std::vector<double>& squared) const;

  AlternatingPart part_;
  std::vector<int> row_of_;     // [particle] index of its weights; −1: none
  std::vector<int> first_row_;  // [body] and one past the last
  double spacing_ = 0;          // m
  double least_stress_ = 0;     // Pa
};

}  // namespace taut
