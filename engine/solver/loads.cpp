#include "engine/solver/loads.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/core.h>

#include "engine/error.hpp"
#include "engine/layout/element_nodes.hpp"
#include "engine/layout/layers.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/turned.hpp"

namespace taut {

namespace {

using Placement = std::function<Point(const Point&)>;

/// Whether a placement maps each axis to an axis.
bool keeps_axes(const Placement& place) {
  constexpr double round_off = 1e-9;
  const Point origin = place({});
  for (std::size_t k = 0; k < origin.size(); ++k) {
    Point end{};
    end[k] = 1;
    end = place(end);
    long along = 0;
    for (std::size_t a = 0; a < end.size(); ++a) along += std::abs(end[a] - origin[a]) > round_off;
    if (along != 1) return false;
  }
  return true;
}

bool is_of_boxes(const Shape& shape, const Placement& to_lattice) {
  if (shape.as<Box>()) return keeps_axes(to_lattice);
  if (const auto* turned = shape.as<Turned>())
    return is_of_boxes(turned->shape,
                       [&](const Point& x) { return to_lattice(rotated(turned->rotation, x)); });
  const auto* combined = shape.as<Combined>();
  return combined && std::ranges::all_of(combined->shapes,
                                         [&](const Shape& part) { return is_of_boxes(part, to_lattice); });
}

/// Whether all faces are along the lattice. On other faces, steps of the lattice look like edges.
bool is_of_boxes(const Body& body) {
  const auto is_along = [&](const Shape& shape) {
    return is_of_boxes(shape, [&](const Point& x) { return body.shapes.front()->to_lattice(x); });
  };
  return std::ranges::all_of(body.shapes, is_along) && std::ranges::all_of(body.without, is_along);
}

}  // namespace

template <int Dim>
Loads<Dim>::Loads(const Scene& scene, const InitialParticles& initial)
    : gravity_(scene.gravity), damping_(scene.damping) {
  active_ = has_loads(scene) || damping_ > 0;
  if (!active_) return;
  work_.assign(initial.size(), 0);
  damped_.assign(initial.size(), 0);
  force_.assign(initial.size(), V{});
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const Load& load : scene.bodies[b].loads)
      regions_.push_back({load.ramp, shares(load, scene, initial, static_cast<int>(b))});
}

template <int Dim>
void Loads<Dim>::set_time(double t) {
  if (!active_) return;
  for (int k = 0; k < Dim; ++k) g_[k] = gravity_[k] ? gravity_[k](t) : 0;
  bool changed = false;
  for (Region& region : regions_) {
    const double now = region.ramp ? region.ramp(t) : 1;
    changed |= now != region.now;
    region.now = now;
  }
  if (!changed) return;
  for (const Region& region : regions_)
    for (const auto& [id, share] : region.shares) force_[id] = V{};
  for (const Region& region : regions_)
    for (const auto& [id, share] : region.shares) force_[id] += region.now * share;
}

template <int Dim>
void Loads<Dim>::act_on_faces(const Scene& scene, const InitialParticles& initial, FaceRule rule,
                              const std::vector<Point>& surface, double reach) {
  auto region = regions_.begin();
  for (const Body& body : scene.bodies) {
    for (const Load& load : body.loads) {
      std::vector<std::pair<int, V>>& shares = (region++)->shares;
      if (load.kind != Load::Kind::traction) continue;
      std::vector<int> ids;
      for (const auto& [id, force] : shares) ids.push_back(id);
      const FaceLayer layer = face_layer(load, body, initial, std::move(ids), scene.spacing);
      if (layer.has_edge && is_of_boxes(body)) refuse_edge(body);
      if (layer.id.empty()) continue;
      shares.clear();
      for (const auto& [id, force] : face_shares(rule, layer, initial, reach, surface, scene.spacing)) {
        V f;
        for (int k = 0; k < Dim; ++k) f[k] = force[k];
        shares.emplace_back(id, f);
      }
    }
  }
}

template <int Dim>
void Loads<Dim>::spread_by(const std::vector<double>& volume, const Scene& scene,
                           const InitialParticles& initial) {
  auto region = regions_.begin();
  for (const Body& body : scene.bodies) {
    for (const Load& load : body.loads) {
      std::vector<std::pair<int, V>>& shares = (region++)->shares;
      if (load.kind == Load::Kind::traction) continue;
      double cells = 0, all = 0;
      for (const auto& [id, force] : shares) cells += initial.V0[id], all += volume[id];
      for (auto& [id, force] : shares) force = (cells / all * volume[id] / initial.V0[id]) * force;
    }
  }
}

/// Shares of a load by id, N. Particles driven to the end take no share of a force.
template <int Dim>
auto Loads<Dim>::shares(const Load& load, const Scene& scene, const InitialParticles& initial, int body)
    -> std::vector<std::pair<int, V>> {
  const auto is_driven = [&](int id) {
    return initial.drive[id] >= 0 && !ends_before_run(scene.bodies[body].drives[initial.drive[id]], scene);
  };
  const bool has_mesh = initial.mesh.order > 0;
  const std::vector<double> of_mesh =
      has_mesh ? load_weights(load, scene, initial, body) : std::vector<double>{};
  const auto weight = [&](int id) { return has_mesh ? of_mesh[id] : initial.V0[id]; };
  const auto is_loaded = [&](int id) {
    return has_mesh ? of_mesh[id] > 0 : load.where(initial.cell(id)) != 0;
  };
  std::vector<int> loaded;
  double volume = 0;  // of particles that are free at some time, m^Dim (traction on elements: m^(Dim − 1))
  for (int id = initial.first[body]; id < initial.first[body + 1]; ++id) {
    if (initial.clamped[id] || !is_loaded(id)) continue;
    if (is_driven(id) && load.kind == Load::Kind::force) continue;
    loaded.push_back(id);
    if (!is_driven(id)) volume += weight(id);
  }
  const std::string& name = scene.bodies[body].name;
  if (has_mesh && std::ranges::max(of_mesh) == 0)
    throw SceneError(
        fmt::format("body.{}.loaded", name),
        fmt::format("a traction of body '{}' is on no face: "
                    "its 'where' must be nonzero in the middle of an element cell at the surface",
                    name));
  if (volume == 0)
    throw SceneError(
        fmt::format("body.{}.loaded", name),
        fmt::format(
            "a load of body '{}' is only on particles that are held, or driven to the end, where it has no effect",
            name));
  double over = 1;
  if (load.kind == Load::Kind::force) over = volume;
  if (load.kind == Load::Kind::traction && !has_mesh) {
    over = layer_thickness(scene.bodies[body], initial, loaded, scene.spacing);
    refuse_deep_traction(load, scene.bodies[body],
                         layers_of_region(load.where, scene.bodies[body], initial, loaded, over));
  }
  std::vector<std::pair<int, V>> shares;
  for (const int id : loaded) {
    V force{};
    for (int k = 0; k < Dim; ++k)
      if (load.value[k]) force[k] = weight(id) / over * load.value[k](initial.x[id]);
    shares.emplace_back(id, force);
  }
  return shares;
}

template class Loads<2>;
template class Loads<3>;

}  // namespace taut
