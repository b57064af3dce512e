#include "engine/diagnostics/measures_in_space.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "engine/core/least_squares.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/diagnostics/lattice_volume.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

std::vector<const Field*> fields_of(const Measure& measure, int dim) {
  std::vector<const Field*> found;
  for (const std::string& key : measure.fields) {
    found.push_back(find_field(key, dim));
    if (found.back() == nullptr)
      throw SceneError(fmt::format("measure.{}.fields", measure.name),
                       fmt::format("there is no field '{}'", key));
  }
  return found;
}

struct Site {
  Point X{};  // m
  Point difference{};
  double mass = 0;
};

/// Subtracts the motion t + ω × X that minimises Σ m |difference|².
void take_plane_motion_off(std::vector<Site>& sites) {
  double mass = 0;
  Point centre{}, mean{};
  for (const Site& site : sites) {
    mass += site.mass;
    for (std::size_t k = 0; k < 2; ++k) {
      centre[k] += site.mass * site.X[k];
      mean[k] += site.mass * site.difference[k];
    }
  }
  double moment = 0, inertia = 0;
  for (std::size_t k = 0; k < 2; ++k) centre[k] /= mass, mean[k] /= mass;
  for (const Site& site : sites) {
    const double x = site.X[0] - centre[0], y = site.X[1] - centre[1];
    moment += site.mass * (x * site.difference[1] - y * site.difference[0]);
    inertia += site.mass * (x * x + y * y);
  }
  const double angle = inertia > 0 ? moment / inertia : 0;
  for (Site& site : sites) {
    site.difference[0] -= mean[0] - angle * (site.X[1] - centre[1]);
    site.difference[1] -= mean[1] + angle * (site.X[0] - centre[0]);
  }
}

Eigen::Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }

void take_space_motion_off(std::vector<Site>& sites) {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), mean = centre, moment = centre;
  for (const Site& site : sites) {
    mass += site.mass;
    centre += site.mass * vector(site.X);
    mean += site.mass * vector(site.difference);
  }
  centre /= mass, mean /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const Site& site : sites) {
    const Eigen::Vector3d r = vector(site.X) - centre;
    moment += site.mass * r.cross(vector(site.difference));
    inertia += site.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  // the rotation of a straight row of particles about its own axis is undetermined
  const Eigen::Vector3d omega = least_squares(inertia, moment).x;
  for (Site& site : sites) {
    const Eigen::Vector3d motion = mean + omega.cross(vector(site.X) - centre);
    for (std::size_t k = 0; k < 3; ++k) site.difference[k] -= motion[static_cast<Eigen::Index>(k)];
  }
}

double squared(const Point& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

}  // namespace

std::optional<FieldError> field_error(const Measure& measure, const Snapshot& now,
                                      const std::vector<Solution>& exact) {
  const std::vector<std::vector<double>> values = evaluate(fields_of(measure, now.dim), now);
  std::vector<Site> sites;
  double scale = 0, sum = 0, greatest = 0;  // squared
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.body[i] != measure.body || now.clamped[i]) continue;
    Site site{now.initial(i), {}, now.m[i]};
    Point should{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      should[k] = exact[k](site.X, now.time);
      site.difference[k] = values[k][i] - should[k];
    }
    scale = std::max(scale, squared(should));
    sites.push_back(site);
  }
  if (!(scale > 0)) return std::nullopt;
  if (measure.rigid_motion_free) now.dim == 3 ? take_space_motion_off(sites) : take_plane_motion_off(sites);
  for (const Site& site : sites) {
    sum += squared(site.difference);
    greatest = std::max(greatest, squared(site.difference));
  }
  return FieldError{std::sqrt(sum / static_cast<double>(sites.size()) / scale), std::sqrt(greatest / scale)};
}

namespace {

using Source = MeasureSource;

struct LineRms {
  double difference = 0, reference = 0;
};

std::optional<LineRms> rms_on_line(const Source& source) {
  if (source.reference.empty() || !source.samples) return std::nullopt;
  const SampleLine& line = *source.line;
  if (source.samples->size() < line.times.size() || source.samples->empty()) return std::nullopt;
  const double apart = length_of(line) / (line.points - 1);
  LineRms sum;
  for (const LineSample& sample : *source.samples) {
    for (int k = 0; k < line.points; ++k) {
      const ReferenceCurves& reference = source.reference;
      const double is = sample.value[static_cast<std::size_t>(k)];
      const double should = reference.exact ? reference.exact->front()(line_point(line, k), sample.time)
                                            : value_at(reference.table.front(), k * apart);
      sum.difference += (is - should) * (is - should);
      sum.reference += should * should;
    }
  }
  const double number = static_cast<double>(line.points) * static_cast<double>(line.times.size());
  if (!std::isfinite(sum.difference)) return std::nullopt;
  return LineRms{std::sqrt(sum.difference / number), std::sqrt(sum.reference / number)};
}

Measured without_line(const Source& source) {
  return source.reference.empty() ? none(no_reference)
                                  : none("the line lacks samples, or one of its points has left the body");
}

std::optional<FieldError> error_at_end(const Source& source) {
  if (!source.reference.exact || !source.now || source.now->time < source.until) return std::nullopt;
  return field_error(*source.measure, *source.now, *source.reference.exact);
}

Measured without_end(const Source& source) {
  if (!source.now) return none("this measure exists only at the end of a run");
  if (source.now->time < source.until) return too_short(source.until, source.now->time);
  return none(no_reference);
}

bool is_clamped(const Snapshot& now, int body) {
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now.body[i] == body && !now.clamped[i]) return false;
  return true;
}

Measured without_field(const Source& source) {
  const bool at_end = source.now && source.now->time >= source.until;
  if (at_end && is_clamped(*source.now, source.measure->body))
    return none("all particles of the body are clamped");
  return at_end && source.reference.exact
             ? none("the reference is 0 everywhere, so there is no relative error")
             : without_end(source);
}

}  // namespace

Measured line_rmse(const Source& source) {
  const auto rms = rms_on_line(source);
  return rms ? Measured(rms->difference) : without_line(source);
}

Measured line_error(const Source& source) {
  const auto rms = rms_on_line(source);
  if (!rms) return without_line(source);
  return rms->reference > 0 ? Measured(rms->difference / rms->reference)
                            : none("the reference is 0 everywhere, so there is no relative error");
}

Measured field_rmse(const Source& source) {
  const auto error = error_at_end(source);
  return error ? Measured(error->rms) : without_field(source);
}

Measured greatest_field_error(const Source& source) {
  const auto error = error_at_end(source);
  return error ? Measured(error->greatest) : without_field(source);
}

Measured volume_change(const Source& source) {
  if (!source.now || source.now->time < source.until) return without_end(source);
  const double before = lattice_volume(*source.now, source.measure->body, source.now->x0);
  if (!(before > 0))
    return none("the lattice of the body is not along the axes, or the body is one particle thick");
  return lattice_volume(*source.now, source.measure->body, source.now->x) / before - 1;
}

}  // namespace taut
