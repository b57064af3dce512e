#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/face_candidates.hpp"
#include "engine/contact/moving_faces.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut {

/// Contact of faces in 2D (terms/surface_contact.hpp). Each node is pushed towards its closest point of the other face.
/// The force is proportional to the length of the node's two half segments, as far as they face this point. Conserves
/// linear and angular momentum.
class FaceContacts final : public ContactMechanism<2> {
 public:
  using V = Vec<double, 2>;

  explicit FaceContacts(const SolverInput& input);

  bool search(const Particles<2>& s, const WallContacts<2>& walls, std::optional<double> way) override;

  void evaluate(const Particles<2>& s, double dt, WallContacts<2>& walls, std::vector<V>& force,
                int threads) override;
  double energy(const Particles<2>& s, const WallContacts<2>& walls) override;
  double stiffening() const override { return touching_.empty() ? 1 : stiffer_than_material(stiffness_); }
  V between(const Particles<2>& s, int a, int b) const override;
  V of_wall(const Particles<2>& s, int a, int wall, const WallContacts<2>& walls) const override;

  /// Least distance between nodes and faces, m; negative for an overlap, at most one spacing.
  double gap(const Particles<2>& s, int a, int b);

  void serialize(Saver& archive, int particles, const WallContacts<2>& walls) override {
    faces_.serialize(archive, particles);
    candidates_.serialize(archive, faces_, walls.count());
  }
  void serialize(Loader& archive, int particles, const WallContacts<2>& walls) override {
    faces_.serialize(archive, particles);
    candidates_.serialize(archive, faces_, walls.count());
    touching_ = candidates_.particles;
  }

 private:
  // in spacings
  static constexpr double reach = 1;        // greatest depth
  static constexpr double own_reach = 1.2;  // within a body of finite elements
  static constexpr double tie = 1e-6;       // round-off of equal distances

  void refuse_thin(const Scene& scene) const;
  void place_watched(const Particles<2>& s);
  template <class F>
  void for_each_touch(const NearFaces& near, const F& f) const;
  template <class F>
  void for_each_wall(const WallContacts<2>& walls, const F& f) const;
  bool fades(const NearFaces& near) const { return has_mesh_ && &near == &candidates_.own_faces; }
  double greatest_depth(const NearFaces& near) const { return (fades(near) ? own_reach : reach) * dp_; }  // m
  /// Depth at which the contact has faded, m.
  double faded(const NearFaces& near) const {
    return fades(near) ? own_reach * dp_ : std::numeric_limits<double>::infinity();
  }
  void act_on_nodes(const Particles<2>& s, double dt, WallContacts<2>& walls);
  double stiffness(int node, int segment) const {  // Pa/m
    const std::array<int, 2>& end = faces_.segment(segment).node;
    return surface_stiffness(M_[node], 0.5 * (M_[end[0]] + M_[end[1]]), stiffness_, dp_);
  }

  double dp_, stiffness_;
  bool has_mesh_;
  MovingFaces faces_;
  std::vector<double> M_;  // [node] K + 4G/3, Pa
  FaceCandidates candidates_;
  // [node] N; two sums, for the same order of additions in mirrored bodies
  std::vector<V> own_force_;
  std::vector<V> reaction_;
};

}  // namespace taut
