#pragma once

#include <optional>
#include <vector>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Errors of a body's fields against an exact solution, relative to the greatest |exact|.
struct FieldError {
  double rms = 0;       // √ of the mean |field − exact|² over the particles
  double greatest = 0;  // |field − exact|
};

/// Error of the measure's fields, components of one vector, at the unclamped particles of its body. `exact`: one
/// function of initial position and time per field. With `rigid_motion_free`, first subtracts the nearest small rigid
/// motion u = t + ω × X. None if the solution is 0 everywhere. Throws SceneError for an unknown field.
std::optional<FieldError> field_error(const Measure& measure, const Snapshot& now,
                                      const std::vector<Solution>& exact);

/// RMS of field − reference over a line and its times; and relative to the RMS of the reference.
Measured line_rmse(const MeasureSource& source);
Measured line_error(const MeasureSource& source);

/// field_error at the end of the run.
Measured field_rmse(const MeasureSource& source);
Measured greatest_field_error(const MeasureSource& source);

/// Relative volume change of a body at the end (lattice_volume.hpp).
Measured volume_change(const MeasureSource& source);

}  // namespace taut
