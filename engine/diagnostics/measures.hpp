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
  std::optional<double> reference;  // may be missing for a law; 0 for differences
  std::string reference_name;
  std::optional<double> error;  // relative; absolute if the reference is 0
  std::string why;
};

/// `law`: key of the reference. Series end before their first non-finite value. Throws SceneError for an unknown kind,
/// probe or field.
std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law,
                                   const std::vector<std::vector<LineSample>>& lines = {},
                                   const Snapshot* now = nullptr);

}  // namespace taut
