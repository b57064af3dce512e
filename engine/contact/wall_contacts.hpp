#pragma once

#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Rigid frictionless walls, each a half-space. A wall acts on a particle like the particle's mirror image.
template <int Dim>
class WallContacts {
 public:
  using V = Vec<double, Dim>;

  explicit WallContacts(const Scene& scene) {
    for (const Wall& wall : scene.walls) {
      Plane plane;
      for (int k = 0; k < Dim; ++k) plane.at[k] = wall.at[k], plane.normal[k] = wall.normal[k];
      planes_.push_back(plane);
    }
  }

  bool any() const { return !planes_.empty(); }
  int count() const { return static_cast<int>(planes_.size()); }
  const V& normal(int wall) const { return planes_[wall].normal; }  // unit vector towards the bodies
  double height(int wall, const V& x) const {                       // above the wall, m
    return dot(x - planes_[wall].at, planes_[wall].normal);
  }

  void record_impulse(const V& x, const V& impulse) {
    for (int k = 0; k < Dim; ++k) recorded_impulse_.linear[k] += impulse[k];
    recorded_impulse_.angular[2] += x[0] * impulse[1] - x[1] * impulse[0];
    if constexpr (Dim == 3) {
      recorded_impulse_.angular[0] += x[1] * impulse[2] - x[2] * impulse[1];
      recorded_impulse_.angular[1] += x[2] * impulse[0] - x[0] * impulse[2];
    }
  }
  const Impulse& recorded_impulse() const { return recorded_impulse_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(recorded_impulse_);
  }

 private:
  struct Plane {
    V at, normal;  // m; unit vector
  };

  std::vector<Plane> planes_;
  Impulse recorded_impulse_;
};

inline constexpr TermInfo wall_info{
    "wall", "the law of contact with the body's own mirror image; sph: the penalty law", "ours",
    "contact/wall_contacts.hpp:WallContacts",
    "wall: a wall acts on a body as a mirror image of the body would"};

}  // namespace taut
