#include "engine/diagnostics/lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "engine/diagnostics/fields.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

const Field& field_of(const SampleLine& line, int dim) {
  const Field* field = find_field(line.field, dim);
  if (field == nullptr)
    throw SceneError(fmt::format("line.{}.field", line.name),
                     fmt::format("there is no field '{}'", line.field));
  return *field;
}

}  // namespace

Point line_point(const SampleLine& line, int k) {
  Point point{};
  const double share = line.points > 1 ? static_cast<double>(k) / (line.points - 1) : 0;
  for (std::size_t a = 0; a < point.size(); ++a) point[a] = std::lerp(line.from[a], line.to[a], share);
  return point;
}

double length_of(const SampleLine& line) {
  return std::hypot(line.to[0] - line.from[0], line.to[1] - line.from[1], line.to[2] - line.from[2]);
}

LineRecorder::LineRecorder(const Scene& scene, const Snapshot& start, double support)
    : lines_(scene.lines), reach_(reach_of_points(support, scene.spacing)), samples_(scene.lines.size()) {
  for (const SampleLine& line : lines_) {
    field_of(line, start.dim);
    points_.push_back(line.in_space ? Points{} : points_of(line, start, &scene));
    for (std::size_t k = 0; k < points_.back().size(); ++k) {
      if (points_.back()[k].empty())
        throw SceneError("line." + line.name,
                         fmt::format("point {} of the line '{}' has too few particles of its body around it",
                                     k + 1, line.name));
    }
  }
}

LineRecorder::Points LineRecorder::points_of(const SampleLine& line, const Snapshot& now,
                                             const Scene* scene) const {
  std::vector<Point> x(now.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = scene ? now.initial(i) : now.position(i);
  const auto [first, last] = std::equal_range(now.body.begin(), now.body.end(), line.body);
  const int begin = static_cast<int>(first - now.body.begin());
  const int end = static_cast<int>(last - now.body.begin());
  const bool of_stress = field_of(line, now.dim).unit == "Pa";
  const double link = scene ? link_of_neighbors * scene->spacing : std::numeric_limits<double>::infinity();
  const Surroundings all{x, now.clamped, now.driven, now.material, begin, end, reach_, link, now.dim};
  Points points;
  for (int k = 0; k < line.points; ++k) {
    const Point at = line_point(line, k);
    std::vector<PointWeight>& point =
        points.emplace_back(scene ? material_point(x, begin, end, at, reach_, *scene, line.body)
                                  : material_point(x, begin, end, at, reach_, now.dim));
    if (!of_stress || point.empty()) continue;
    std::vector<PointWeight> of_free = point_of_stress(point, all, at);
    if (!of_free.empty()) point = std::move(of_free);  // empty deep inside a clamp
  }
  return points;
}

bool LineRecorder::fit_the_scene() const {
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    if (samples_[l].size() > lines_[l].times.size()) return false;
    for (const LineSample& sample : samples_[l])
      if (std::cmp_not_equal(sample.value.size(), lines_[l].points)) return false;
  }
  return true;
}

double LineRecorder::next() const {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < lines_.size(); ++l)
    if (samples_[l].size() < lines_[l].times.size())
      next = std::min(next, lines_[l].times[samples_[l].size()]);
  return next;
}

void LineRecorder::sample(const Snapshot& now) {
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const SampleLine& line = lines_[l];
    while (samples_[l].size() < line.times.size() && line.times[samples_[l].size()] <= now.time) {
      LineSample sample{now.time, now.step, {}};
      const std::vector<double> values = evaluate(field_of(line, now.dim), now);
      for (const std::vector<PointWeight>& point :
           line.in_space ? points_of(line, now, nullptr) : points_[l]) {
        double value = point.empty() ? std::numeric_limits<double>::quiet_NaN() : 0;
        for (const PointWeight& w : point) value += w.weight * values[static_cast<std::size_t>(w.particle)];
        sample.value.push_back(value);
      }
      samples_[l].push_back(std::move(sample));
    }
  }
}

}  // namespace taut
