#pragma once

#include <string>
#include <vector>

#include "engine/layout/material_point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// A line's field at one time.
struct LineSample {
  double time = 0;            // s
  long step = 0;              // that ends at this time, or is the first to end after it
  std::vector<double> value;  // at the line's points, in the field's unit; no number outside of the body

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, step, value);
  }
};

/// A point of a line, at t = 0 where it is a material one, from the first one at `from` to the last one at
/// `to`.
Point line_point(const SampleLine& line, int k);
double length_of(const SampleLine& line);  // m

/// Samples the lines of a scene.
class LineRecorder {
 public:
  /// `start` is the state at t = 0 and `support` the radius within which particles act on each other, m. Throws
  /// SceneError for a line that leaves its body.
  LineRecorder(const Scene& scene, const Snapshot& start, double support);

  /// The next time that is not sampled yet, s; infinity when there is none.
  double next() const;
  /// Takes what is due by the time of `now`, as it is then.
  void sample(const Snapshot& now);
  /// [line][sample], in the order of their times.
  const std::vector<std::vector<LineSample>>& samples() const { return samples_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(samples_);
    archive.check("a sample of a line", [&] { return fit_the_scene(); });
  }

 private:
  bool fit_the_scene() const;  // the samples

  using Points = std::vector<std::vector<PointWeight>>;
  /// In the layout of the scene, or where particles are now.
  Points points_of(const SampleLine& line, const Snapshot& now, const Scene* scene) const;

  std::vector<SampleLine> lines_;
  double reach_;                // m
  std::vector<Points> points_;  // [line][point], of material points
  std::vector<std::vector<LineSample>> samples_;
};

}  // namespace taut
