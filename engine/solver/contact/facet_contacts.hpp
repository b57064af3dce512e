#pragma once

#include <utility>
#include <vector>

#include "engine/scene/surface_mesh.hpp"
#include "engine/solver/contact/facet_search.hpp"
#include "engine/solver/contact/moving_facets.hpp"
#include "engine/solver/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut::inline TAUT_ISA {

/// What faces of bodies do to each other in 3D where they overlap, by the law of terms/surface_contact.hpp: the
/// slope of an energy of all facets, each of which lies so deep behind the mean of the facets of another body
/// around it. A body that folds meets itself in the same way.
class FacetContacts {
 public:
  using V = Vec<double, 3>;

  explicit FacetContacts(const SolverInput& input);

  /// The facets that may act before the next search. `search` does it after the particles have been stored
  /// in another order; `prepare` where the next way of the fastest particle, m, asks for it: true if it did.
  void search(const Particles<3>& s, const WallContacts<3>& walls);
  bool prepare(const Particles<3>& s, const WallContacts<3>& walls, double way);

  /// Particles that may get a force, in rising order.
  const std::vector<int>& touching() const { return touching_; }

  /// Sets the forces on `touching`, N; what walls give in `dt`, s, is booked.
  void evaluate(const Particles<3>& s, double dt, WallContacts<3>& walls, std::vector<V>& force, int threads);
  double energy(const Particles<3>& s, const WallContacts<3>& walls);  // J
  /// How much stiffer than at first touch it is anywhere, as last evaluated.
  double stiffening() const { return stiffening_; }

  /// On body `a` of body `b` or of a wall, N, as last evaluated.
  V between(int a, int b) const;
  V of_wall(int a, int wall, const WallContacts<3>& walls) const;

  /// Least height of a facet of one of two bodies over a face of the other, m, below 0 where they overlap; a
  /// spacing where they are further apart.
  double gap(const Particles<3>& s, int a, int b);

  template <class Archive>
  void serialize(Archive& archive, int particles, int walls) {
    facets_.serialize(archive, particles);
    find_.serialize(archive, walls);
    archive(stiffening_);
    if constexpr (Archive::loads) list();
  }

 private:
  // in spacings
  static constexpr double before = 1, behind = 1.5;  // how far a face still counts for a facet
  static constexpr double radius = 1.5;              // of the mean over a face, at most
  static constexpr double apart = 2.13;              // √(behind² + radius²), of facets that act
  double reach_at(double p) const { return (p < 0 ? behind : before) * dp_; }

  /// A facet and a body, its own or another,
  struct Row {
    int facet, body;
  };
  /// and what the facets of that body are to it now.
  struct Met {
    int near = 0;              // how many count
    double cover = 0;          // the sum of their weights W
    double height = 0, M = 0;  // the means of p, m, and of M, Pa
    double k = 0;              // Pa/m
    // slopes of the energy in that sum, J, and in the two of one of them, over its W, N and m³
    double per_sum = 0, per_p = 0, per_M = 0;
    double per_weight(double p, double modulus) const {  // in the W of one of them, J
      return per_sum + per_p * (p - height) + per_M * (modulus - M);
    }
  };
  struct Pair {
    V d, middle;                                        // x_f − x_g, m; (n_g − n_f)/|n_g − n_f|
    double p, l2, radius, cosine, share, weight, near;  // of W: R, s, w and c
  };

  double weight_of(const Pair& pair) const { return pair.share * pair.weight * pair.near; }  // 1/m²
  double area_of(int facet) const { return facets_.mesh().facets[facet].area; }  // at the start, m²
  void refuse_thin(const Scene& scene) const;
  void list();
  void place(const Particles<3>& s);
  Met measured(int row);
  MovingFacets::Slope slope_of(int row) const;
  template <class F>
  void for_each_pair(int row, const int* first, int count, const F& f) const;
  template <class F>
  void for_each_wall(const WallContacts<3>& walls, const F& f) const;

  double dp_, stiffness_, stiffening_ = 1;
  int threads_ = 1;
  MovingFacets facets_;
  std::vector<double> M_;  // [facet] K + 4G/3, Pa
  FacetSearch find_;

  std::vector<Row> rows_;                    // by facet, then body
  std::vector<int> begin_, other_;           // [row] the rows of the facets near it, in rising order
  std::vector<Met> met_;                     // [row]
  std::vector<int> near_;                    // those of them that count now, from the same place on
  std::vector<MovingFacets::Slope> slopes_;  // [row]
  std::vector<int> watched_;                 // facets whose place counts, in rising order
  std::vector<int> nodes_;                   // theirs
  std::vector<int> touching_;                // particles
  std::vector<V> force_;                     // [node] N
};

}  // namespace taut::inline TAUT_ISA
