#pragma once

#include <optional>
#include <vector>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Relative to the greatest |exact|.
struct FieldError {
  double rms = 0;       // of |field − exact|
  double greatest = 0;  // |field − exact|
};

/// Error of vector fields at unclamped particles of the measure's body. `exact`: functions of initial position and
/// time. Subtracts the best small rigid motion t + ω × X if it is free. None if the solution is 0. Throws SceneError
/// for an unknown field.
std::optional<FieldError> field_error(const Measure& measure, const Snapshot& now,
                                      const std::vector<Solution>& exact);

/// RMS of field − reference over line and times; the second relative to the reference.
Measured line_rmse(const MeasureSource& source);
Measured line_error(const MeasureSource& source);

/// See field_error, at the end of the run.
Measured field_rmse(const MeasureSource& source);
Measured greatest_field_error(const MeasureSource& source);

/// Relative, at the end (lattice_volume.hpp).
Measured volume_change(const MeasureSource& source);

}  // namespace taut
