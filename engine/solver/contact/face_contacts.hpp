#pragma once

#include <array>
#include <utility>
#include <vector>

#include "engine/scene/outline.hpp"
#include "engine/solver/contact/face_search.hpp"
#include "engine/solver/contact/motion_bound.hpp"
#include "engine/solver/contact/moving_faces.hpp"
#include "engine/solver/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut::inline TAUT_ISA {

/// What faces of bodies do to each other where they overlap, by the law of terms/surface_contact.hpp: each
/// node of a face is pushed to its closest point of the other face, which is pushed back; that force goes to
/// the ends of its segment by ξ, and from nodes to particles by their weights. A node presses with the length of
/// its face that lies over the other one. So both momenta are kept, and the force is the slope of an energy but
/// for what facing_share does where a corner turns.
///
/// Own faces of a body count, if the input says so, for segments that were further than `far_apart` from a
/// node at the start: a body that folds meets itself.
template <int Dim>
class FaceContacts {
 public:
  using V = Vec<double, Dim>;

  explicit FaceContacts(const SolverInput& input);

  /// The segments that may act before the next search. `search` does it after the particles have been stored
  /// in another order; `prepare` where the next way of the fastest particle, m, asks for it: true if it did.
  void search(const Particles<Dim>& s, const WallContacts<Dim>& walls);
  bool prepare(const Particles<Dim>& s, const WallContacts<Dim>& walls, double way);

  /// Particles that may get a force, in rising order.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces on `touching`, N (per metre depth in 2D); what walls give in `dt`, s, is booked.
  /// On one thread, whatever there are: a touching face has too few nodes for a second one.
  void evaluate(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls, std::vector<V>& force,
                int threads);
  double energy(const Particles<Dim>& s, const WallContacts<Dim>& walls);  // J (per metre depth in 2D)
  double stiffening() const { return 1; }                                  // as in 3D

  /// On body `a` of body `b` or of a wall, N (per metre depth in 2D), as last evaluated.
  V between(int a, int b) const;
  V of_wall(int a, int wall, const WallContacts<Dim>& walls) const;

  /// Least signed distance of a node of one of two bodies from a face of the other, m, below 0 where they
  /// overlap, by less than `reach`; that where they are further apart.
  double gap(const Particles<Dim>& s, int a, int b);

  template <class Archive>
  void serialize(Archive& archive, int particles, int walls) {
    faces_.serialize(archive, particles);
    for (NearFaces* near : {&others_, &own_})
      near->serialize(archive, all_nodes_.size(), all_segments_.size());
    archive.indices(near_wall_, std::pair(faces_.size(), walls));
    archive(others_bound_, own_bound_);
    archive.indices(watched_, faces_.size());
    watch_segments();
    archive.indices(touching_, particles);
  }

 private:
  // in spacings
  static constexpr double reach = 1;         // a node that is further behind a face is not of this contact
  static constexpr double skin = 1;          // longer: fewer searches, more pairs
  static constexpr double horizon = 4;       // how far a search looks, for how long it may hold
  static constexpr double far_apart = 3;     // the two faces of a thinner wall do not act on each other
  static constexpr double aside = 0.5;       // cosine of normals from which on two faces are far from facing
  static constexpr double close_by = 4;      // at the start: such faces face each other only where the body
  static constexpr double folded = -0.1;     // has folded, below this cosine of normals
  static constexpr double turn_slack = 0.5;  // of two nodes around the particles behind them
  static constexpr double tie = 1e-6;        // of distances that are the same but for round-off

  void refuse_thin(const Scene& scene) const;
  void search_others(const WallContacts<Dim>& walls);
  std::vector<char> near_others() const;
  void search_own(const Particles<Dim>& s);
  bool looks_aside(int node, int segment) const;
  void watch();
  void watch_segments();
  void place_watched(const Particles<Dim>& s);
  template <class F>
  void for_each_touch(const NearFaces& near, const F& f) const;
  template <class F>
  void for_each_wall(const WallContacts<Dim>& walls, const F& f) const;
  void act_on_nodes(const Particles<Dim>& s, double dt, WallContacts<Dim>& walls);
  double stiffness(int node, int segment) const {  // Pa/m
    const std::array<int, 2>& end = faces_.segment(segment).node;
    return surface_stiffness(M_[node], 0.5 * (M_[end[0]] + M_[end[1]]), stiffness_, dp_);
  }

  double dp_, stiffness_;
  bool meets_itself_, meets_others_;  // others: bodies or walls
  MovingFaces<Dim> faces_;
  std::vector<double> M_;  // [node] K + 4G/3, Pa
  std::vector<int> all_nodes_, all_segments_;
  FaceSearch<Dim> find_;
  std::vector<V> normal_;  // [segment] at a search

  NearFaces others_, own_;
  std::vector<std::pair<int, int>> near_wall_;  // (node, wall)
  MotionBound<Dim> others_bound_, own_bound_;
  std::vector<V> behind_;              // [node] the particle behind it, m
  std::vector<int> watched_;           // nodes whose place counts, in rising order
  std::vector<int> watched_segments_;  // both of whose ends are
  std::vector<int> touching_;          // particles
  // [node] N; apart, so that each is summed in the order of nodes, which mirrored bodies share
  std::vector<V> own_force_;  // from what the nodes of its own body meet
  std::vector<V> reaction_;   // from nodes of other bodies
};

}  // namespace taut::inline TAUT_ISA
