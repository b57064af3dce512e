#include "engine/diagnostics/field_error.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/core/least_squares.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

std::vector<const Field*> fields_of(const Measure& measure, int dim) {
  std::vector<const Field*> found;
  for (const std::string& key : measure.fields) {
    found.push_back(find_field(key, dim));
    if (found.back() == nullptr)
      throw SceneError("measure." + measure.name + ".fields", "there is no field '" + key + "'");
  }
  return found;
}

/// What is compared, at one particle.
struct Site {
  Point X{};           // at the start, m
  Point difference{};  // field − exact, component by component
  double mass = 0;
};

/// Takes the small motion t + ω × X of least Σ m |difference|² off, in 2D.
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

/// The same in 3D: ω solves Σ m (r² I − r rᵀ) ω = Σ m r × difference, r from the mass centre.
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
  // a body on a line has no turn about it
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
  const std::vector<const Field*> fields = fields_of(measure, now.dim);
  std::vector<Site> sites;
  double scale = 0, sum = 0, greatest = 0;  // squares
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now.body[i] != measure.body || now.held[i]) continue;
    Site site{now.initial(i), {}, now.m[i]};
    Point should{};
    for (std::size_t k = 0; k < fields.size(); ++k) {
      should[k] = exact[k](site.X, now.time);
      site.difference[k] = fields[k]->value(now, i) - should[k];
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

}  // namespace taut
