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
  std::optional<double> value;      // none: `why` says why
  std::optional<double> reference;  // none: no reference for these parameters and this material; 0 of what is
                                    // a difference from it
  std::string reference_name;       // empty without reference
  std::optional<double> error;      // |value − reference| / |reference|; where the reference is 0, |value|
  std::string why;                  // there is no value; else empty
};

/// Every measure of the scene (diagnostics/measure_kinds.hpp) from the series and the samples of `lines`
/// recorded so far and the present state, against the reference of material `law`. Between steps a series is
/// a straight line, peaks are those of a parabola through three steps; what follows a value that is not
/// finite is left out. Throws SceneError for a kind, a probe or a field that does not exist.
std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law,
                                   const std::vector<std::vector<LineSample>>& lines = {},
                                   const Snapshot* now = nullptr);

}  // namespace taut
