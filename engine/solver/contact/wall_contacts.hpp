#pragma once

#include <utility>
#include <vector>

#include "engine/methods/term_info.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/particles.hpp"

namespace taut::inline TAUT_ISA {

/// Rigid walls: half-spaces that nothing enters. A wall acts on a particle as the particle's own mirror image
/// in it would by the law of contact, twice the height away, so that a body on a wall does what it would do
/// on an equal one that meets it. Without friction. What it gives to the bodies is booked.
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
  const V& normal(int wall) const { return planes_[wall].normal; }  // to the side of the bodies
  double height(int wall, const V& x) const {                       // of x over it, m
    return dot(x - planes_[wall].at, planes_[wall].normal);
  }

  /// The particles less than `reach`, m, from their image.
  void search(const Particles<Dim>& s, double reach) {
    near_.clear();
    for (int i = 0; i < s.size(); ++i)
      for (int w = 0; w < static_cast<int>(planes_.size()); ++w)
        if (distance_from_image(planes_[w], s.x[i]) < reach) near_.emplace_back(i, w);
  }
  /// (particle, wall), by particle.
  const std::vector<std::pair<int, int>>& near() const { return near_; }

  /// f(i, wall, x, r) for each of them less than `reach` from its image as it was `gone` seconds ago: its
  /// place x then, and the distance r, below 0 inside the wall.
  template <class F>
  void for_each_touch(const Particles<Dim>& s, double reach, double gone, const F& f) const {
    for (const auto& [i, w] : near_) {
      const V x = s.x[i] - gone * s.v[i];
      const double r = distance_from_image(planes_[w], x);
      if (r < reach) f(i, w, x, r);
    }
  }

  /// An impulse, N s, that a particle at x has got.
  void book(const V& x, const V& impulse) {
    for (int k = 0; k < Dim; ++k) given_.linear[k] += impulse[k];
    given_.angular[2] += x[0] * impulse[1] - x[1] * impulse[0];
    if constexpr (Dim == 3) {
      given_.angular[0] += x[1] * impulse[2] - x[2] * impulse[1];
      given_.angular[1] += x[2] * impulse[0] - x[0] * impulse[2];
    }
  }
  const Impulse& given() const { return given_; }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.indices(near_, std::pair(particles, count()));
    archive(given_);
  }

 private:
  struct Plane {
    V at, normal;  // m, of length 1
  };
  static double distance_from_image(const Plane& plane, const V& x) {
    return 2 * dot(x - plane.at, plane.normal);
  }

  std::vector<Plane> planes_;
  std::vector<std::pair<int, int>> near_;
  Impulse given_;
};

inline constexpr TermInfo wall_info{
    "wall", "the law of contact with the body's own mirror image; sph: the penalty law", "ours",
    "solver/contact/wall_contacts.hpp:WallContacts", "wall: a body meets its mirror image"};

}  // namespace taut::inline TAUT_ISA
