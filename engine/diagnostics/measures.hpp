#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/lines.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/running.hpp"

namespace taut {

struct MeasureResult {
  std::string name, unit;
  std::optional<double> value;      // none: the run was too short; rmse, path_error: or there is no reference
  std::optional<double> reference;  // none: no reference for these parameters and this material; rmse,
                                    // path_error: 0
  std::string reference_name;       // empty without reference
  std::optional<double> error;      // |value − reference| / |reference|; where the reference is 0, |value|
};

/// Every measure of the scene from the series and the samples of `lines` recorded so far and the present
/// state, against the reference of material `law`. Between steps a series is a straight line (first_peak and
/// decay: a parabola through three steps); what follows a value that is not finite is left out.
///
///   period, first_peak, decay  a half cycle lies between two crossings of zero; one that only touches zero
///                              goes on, and one that has not ended yet does not count. A peak keeps its
///                              sign. decay = 1 − (A_n/A_1)^(1/(n−1)) of the n ≥ 2 peaks on the side of the
///                              first.
///   rmse                       √(1/T ∫ (series − reference)² dt) over the time that both cover, up to
///                              `until`; the reference's table or exact solution is found by the measure's
///                              name. Its reference is 0: it is its own error.
///   path_error                 greatest distance of the point (x, y) of two probes from where the reference
///                              has it at the same time, over `scale`, at the rows of its table or at the
///                              steps; as rmse else.
///   line_rmse                  √ of the mean of (field − reference)² over all points of the line and all its
///                              times, the reference at the time of the step that was sampled; none before
///                              the last sample. Its reference is 0.
///   turn                       angle of the point (x, y) of two probes about the origin from the start to
///                              `until`, whole turns counted; none before. Its reference is the turn of the
///                              reference's path up to `until`.
///   at_rest                    the value at the end of the run; none before, and where the series still
///   moved
///                              by more than a thousandth of its greatest size in the last tenth. Its
///                              reference may be a solution, at `until`.
///   field_rmse, field_error    √ of the mean, or the greatest, of |field − reference| over all particles
///   that
///                              are not held, in their places at the start, over the greatest |reference| of
///                              them; none before the end of the run, of which `now` is the state. Their
///                              reference is 0.
///   frequency                  see diagnostics/spectrum.hpp; from `from` to `until`, none before.
///   minimum, maximum           none while the series ends at its extreme, which may then still be ahead;
///                              mirror_asymmetry is a fault that grows, so there the extreme so far counts.
///   final_ratio                none while `free` ends ≤ threshold (in touch), if it never was (no contact),
///                              and while it is negative: bodies that part for a moment go on as before.
///
/// Throws SceneError for a measure of a probe that does not exist.
std::vector<MeasureResult> measure(const Scene& scene, const Series& series, std::string_view law,
                                   const std::vector<std::vector<LineSample>>& lines = {},
                                   const Snapshot* now = nullptr);

}  // namespace taut
