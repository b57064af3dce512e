#pragma once

#include <string>
#include <vector>

#include "engine/layout/material_point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Field along a line at one time.
struct LineSample {
  double time = 0;            // s
  long step = 0;              // the first step that ends at or after the requested time
  std::vector<double> value;  // [point] in the field's unit; NaN outside the body

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, step, value);
  }
};

/// Point k of a line from `from` to `to`; a material point if the line is not `in_space`.
Point line_point(const SampleLine& line, int k);
double length_of(const SampleLine& line);  // m

/// Samples the lines of a scene.
class LineRecorder {
 public:
  /// `start`: state at t = 0; `support`: radius of interaction, m. Throws SceneError if a line leaves its body.
  LineRecorder(const Scene& scene, const Snapshot& start, double support);

  /// Next time to be sampled, s; infinity if none.
  double next() const;
  /// Records the samples due by the time of `now`, from `now`.
  void sample(const Snapshot& now);
  /// [line][sample] by time.
  const std::vector<std::vector<LineSample>>& samples() const { return samples_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(samples_);
    archive.check("a sample of a line", [&] { return fit_the_scene(); });
  }

 private:
  bool fit_the_scene() const;

  using Points = std::vector<std::vector<PointWeight>>;
  /// Points at initial positions if `scene` is given, else at current ones.
  Points points_of(const SampleLine& line, const Snapshot& now, const Scene* scene) const;

  std::vector<SampleLine> lines_;
  double reach_;                // m
  std::vector<Points> points_;  // [line][point] material points
  std::vector<std::vector<LineSample>> samples_;
};

}  // namespace taut
