#pragma once

#include <optional>
#include <vector>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Errors relative to the greatest |exact|.
struct FieldError {
  double rms = 0;
  double greatest = 0;
};

/// Error of the vector `measure.fields` at unclamped particles; none if `exact` is 0 at all of them. Throws SceneError
/// for an unknown field.
std::optional<FieldError> field_error(const Measure& measure, const Snapshot& now,
                                      const std::vector<Solution>& exact);

Measured line_rmse(const MeasureSource& source);
Measured line_error(const MeasureSource& source);

Measured field_rmse(const MeasureSource& source);
Measured greatest_field_error(const MeasureSource& source);

Measured volume_change(const MeasureSource& source);

}  // namespace taut
