#pragma once

#include <optional>
#include <vector>

#include "engine/contact/contact_mechanism.hpp"
#include "engine/contact/facet_candidates.hpp"
#include "engine/contact/moving_facets.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut {

/// Contact of faces in 3D (terms/surface_contact.hpp), derived from an energy. The depth of a facet is a mean over
/// nearby facets of the other body or fold.
class FacetContacts final : public ContactMechanism<3> {
 public:
  using V = Vec<double, 3>;

  explicit FacetContacts(const SolverInput& input);

  bool search(const Particles<3>& s, const WallContacts<3>& walls, std::optional<double> way) override;

  void evaluate(const Particles<3>& s, double dt, WallContacts<3>& walls, std::vector<V>& force,
                int threads) override;
  double energy(const Particles<3>& s, const WallContacts<3>& walls) override;
  double stiffening() const override {
    return touching_.empty() ? 1 : stiffer_than_material(stiffness_) * hardening_;
  }
  V between(const Particles<3>& s, int a, int b) const override;
  V of_wall(const Particles<3>& s, int a, int wall, const WallContacts<3>& walls) const override;

  /// Least height of a facet of one body above the other, m; negative for an overlap, at most one spacing.
  double gap(const Particles<3>& s, int a, int b);

  void serialize(Saver& archive, int particles, const WallContacts<3>& walls) override {
    transfer(archive, particles, walls);
  }
  void serialize(Loader& archive, int particles, const WallContacts<3>& walls) override {
    transfer(archive, particles, walls);
    list();
  }

 private:
  // in spacings
  static constexpr double before = 1, behind = 1.5;
  static constexpr double radius = 1.5;  // lateral range
  static constexpr double apart = 2.13;  // above √(behind² + radius²)
  double reach_at(double p) const { return (p < 0 ? behind : before) * dp_; }

  struct Row {
    int facet, body;
  };
  struct Touch {
    int near = 0;              // facets in range
    double cover = 0;          // Σ W, W = facet area × weight_of(pair)
    double height = 0, M = 0;  // means with weights W: of p in m, of K + 4G/3 in Pa
    double k = 0;              // Pa/m
    // ∂E/∂cover in J; (∂E/∂height)/cover in N; (∂E/∂M)/cover in m³
    double per_sum = 0, per_p = 0, per_M = 0;
    double per_weight(double p, double modulus) const {  // ∂E/∂W of one facet, J
      return per_sum + per_p * (p - height) + per_M * (modulus - M);
    }
  };
  struct Pair {
    V d, middle;                                        // x_f − x_g, m; (n_g − n_f)/|n_g − n_f|
    double p, l2, radius, cosine, share, weight, near;  // terms/THEORY.md: p, ℓ², R, cosine, s, w, c
  };

  double weight_of(const Pair& pair) const { return pair.share * pair.weight * pair.near; }  // 1/m²
  double area_of(int facet) const { return facets_.mesh().facets[facet].area; }              // initial, m²
  template <class Archive>
  void transfer(Archive& archive, int particles, const WallContacts<3>& walls) {
    facets_.serialize(archive, particles);
    candidates_.serialize(archive, walls.count());
    archive(hardening_);
  }
  void refuse_thin(const Scene& scene) const;
  void list();
  void place(const Particles<3>& s);
  Touch measured(int row);
  MovingFacets::Slope slope_of(int row) const;
  template <class F>
  void for_each_pair(int row, const int* first, int count, const F& f) const;
  template <class F>
  void for_each_wall(const WallContacts<3>& walls, const F& f) const;

  double dp_, stiffness_;
  double hardening_ = 1;  // greatest stiffness, relative to first touch
  int threads_ = 1;
  MovingFacets facets_;
  std::vector<double> M_;  // [facet] K + 4G/3, Pa
  FacetCandidates candidates_;

  std::vector<Row> rows_;
  std::vector<int> begin_, other_;           // [row] first pair; [pair] row of the other facet
  std::vector<Touch> touches_;               // [row]
  std::vector<int> near_;                    // rows in range of row r, from begin_[r] on
  std::vector<MovingFacets::Slope> slopes_;  // [row]
  std::vector<int> watched_;                 // facets, ascending
  std::vector<int> nodes_;                   // of `watched_`
  std::vector<V> force_;                     // [node] N
};

}  // namespace taut
