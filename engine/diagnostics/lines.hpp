#pragma once

#include <string>
#include <vector>

#include "engine/layout/material_point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

struct LineSample {
  double time = 0;            // s
  long step = 0;              // ends at or after the requested time
  std::vector<double> value;  // [point]; NaN if too few particles are within reach

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, step, value);
  }
};

/// Initial position unless `in_space`.
Point line_point(const SampleLine& line, int k);
double length_of(const SampleLine& line);  // m

class LineRecorder {
 public:
  /// `support`: radius of interaction, m. Throws SceneError for an unknown field or too few particles around a material
  /// point.
  LineRecorder(const Scene& scene, const Snapshot& start, double support);

  /// Next sampling time, s; may be infinite.
  double next() const;
  void sample(const Snapshot& now);
  const std::vector<std::vector<LineSample>>& samples() const { return samples_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(samples_);
    archive.check("a sample of a line", [&] { return fit_the_scene(); });
  }

 private:
  bool fit_the_scene() const;

  using Points = std::vector<std::vector<PointWeight>>;
  Points points_of(const SampleLine& line, const Snapshot& now, const Scene* scene) const;

  std::vector<SampleLine> lines_;
  double reach_;  // m
  std::vector<Points> points_;
  std::vector<std::vector<LineSample>> samples_;
};

}  // namespace taut
