#pragma once

#include <string>
#include <vector>

#include "engine/layout/material_point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// The field of a line at one time.
struct LineSample {
  double time = 0;            // s
  long step = 0;              // ends at or just after the requested time
  std::vector<double> value;  // [point], in the field's unit; NaN outside the body

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, step, value);
  }
};

/// Point k between `from` and `to`; initial position unless `in_space`.
Point line_point(const SampleLine& line, int k);
double length_of(const SampleLine& line);  // m

class LineRecorder {
 public:
  /// `support`: radius of interaction, m. Throws SceneError if a line leaves its body.
  LineRecorder(const Scene& scene, const Snapshot& start, double support);

  /// Next time to sample, s; may be infinite.
  double next() const;
  /// Records samples due at the time of `now`.
  void sample(const Snapshot& now);
  /// [line][sample].
  const std::vector<std::vector<LineSample>>& samples() const { return samples_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(samples_);
    archive.check("a sample of a line", [&] { return fit_the_scene(); });
  }

 private:
  bool fit_the_scene() const;

  using Points = std::vector<std::vector<PointWeight>>;
  /// At initial positions if `scene` is given, else at current ones.
  Points points_of(const SampleLine& line, const Snapshot& now, const Scene* scene) const;

  std::vector<SampleLine> lines_;
  double reach_;                // m
  std::vector<Points> points_;  // [line][point], if material
  std::vector<std::vector<LineSample>> samples_;
};

}  // namespace taut
