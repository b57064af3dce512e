#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/lines.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

struct MeasureResult {
  std::string name, kind, unit;
  std::optional<double> value;      // none: see `why`
  std::optional<double> reference;  // none for these parameters or this law; 0 if the value is a difference
  std::string reference_name;       // empty without reference
  std::optional<double> error;      // |value − reference| / |reference|, or |value| if the reference is 0
  std::string why;                  // reason for a missing value
};

/// Evaluates the measures of the scene (measure_kinds.hpp) from series, line samples and current state against the
/// reference of material `law`. Series are linear between steps; peaks are vertices of parabolas through three steps.
/// A series ends before its first non-finite value. Throws SceneError for an unknown kind, probe or field.
std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law,
                                   const std::vector<std::vector<LineSample>>& lines = {},
                                   const Snapshot* now = nullptr);

}  // namespace taut
