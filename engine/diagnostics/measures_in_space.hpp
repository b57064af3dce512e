#pragma once

#include <optional>
#include <vector>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// How far fields of a body are from an exact solution, over the greatest size of the solution.
struct FieldError {
  double rms = 0;       // √ of the mean over the particles of |field − exact|²
  double greatest = 0;  // |field − exact|
};

/// Of the measure's body and fields, components of one vector, at particles that are not held; `exact` has
/// one function of the place at the start and the time for each field. Where rigid motion is free, the small
/// one u = t + ω × X nearest to the difference is taken off it first. None where the solution is 0
/// everywhere. Throws SceneError for a field that does not exist.
std::optional<FieldError> field_error(const Measure& measure, const Snapshot& now,
                                      const std::vector<Solution>& exact);

/// Along a line at its times: √ of the mean of (field − reference)², and that over the same of the reference.
Measured line_rmse(const MeasureSource& source);
Measured line_error(const MeasureSource& source);

/// Over a body at the end, as shares of the greatest size of the reference (field_error).
Measured field_rmse(const MeasureSource& source);
Measured greatest_field_error(const MeasureSource& source);

/// Of a body at the end, over its volume at the start (lattice_volume.hpp).
Measured volume_change(const MeasureSource& source);

}  // namespace taut
