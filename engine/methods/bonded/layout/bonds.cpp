#include "engine/methods/bonded/layout/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

#include "engine/methods/bonded/layout/bond_gradients.hpp"
#include "engine/methods/bonded/layout/layout_bonds.hpp"
#include "engine/methods/bonded/layout/solid_bonds.hpp"
#include "engine/terms/bond.hpp"

namespace taut {
namespace {

/// c r0²/V0 (THEORY.md, Faces).
double lacking_along_free_face(const Material& material) {
  const double G = material.shear_modulus(), lambda = material.bulk_modulus() - 2.0 / 3 * G,
               thinner = lambda / (lambda + 2 * G);
  return 1.1 * 5 / 16 * (1.5 - thinner - 1.5 * thinner * thinner);
}

int neighbor_towards(const Bonds& bonds, int i, const Eigen::Vector2d& d) {
  constexpr double nearly = 0.99;  // cosine
  int found = -1;
  bonds.for_each(i, [&](int j, const ReferenceBond& bond) {
    const Eigen::Vector2d X = vector_of<2>(bond.X);
    if (X.dot(d) > nearly * X.norm() * d.norm()) found = j;
  });
  return found;
}

/// Face terms at particles with five bonds and at the two behind each (THEORY.md, Faces).
std::vector<FaceTerm> make_face_terms(const Scene& scene, const InitialParticles& initial, const Bonds& uncut,
                                      const std::vector<Point>& S) {
  constexpr int inside = 8, at_face = 5;
  const auto count = [&](int i) { return uncut.begin[i + 1] - uncut.begin[i]; };
  const auto has_one_material = [&](int i) {
    return std::all_of(uncut.j.begin() + uncut.begin[i], uncut.j.begin() + uncut.begin[i + 1],
                       [&](int j) { return initial.material[j] == initial.material[i]; });
  };
  std::vector<bool> has_nearest_only(scene.bodies.size(), true);
  for (int i = 0; i < initial.size(); ++i)
    if (count(i) > inside) has_nearest_only[initial.body[i]] = false;
  std::vector<FaceTerm> terms;
  for (int i = 0; i < initial.size(); ++i) {
    if (!has_nearest_only[initial.body[i]] || count(i) != at_face) continue;
    const Eigen::Vector2d inwards = -vector_of<2>(S[i]);
    const int second = neighbor_towards(uncut, i, inwards),
              third = second < 0 ? -1 : neighbor_towards(uncut, second, inwards);
    if (third < 0 || !has_one_material(i) || !has_one_material(second) || !has_one_material(third)) continue;
    const Eigen::Vector2d X = vector_of<2>(initial.x[second]) - vector_of<2>(initial.x[i]);
    const double c =
        lacking_along_free_face(scene.materials[initial.material[i]]) * initial.V0[i] / X.squaredNorm();
    const Point t{-X[1], X[0]};
    terms.push_back({i, t, -c});
    terms.push_back({second, t, 1.2 * c});
    terms.push_back({third, t, -0.2 * c});
  }
  std::ranges::stable_sort(terms, {}, &FaceTerm::i);
  return terms;
}

template <int Dim>
class BondFinisher {
 public:
  BondFinisher(const Scene& scene, const InitialParticles& initial, const Constraints& constraints)
      : scene_(scene), initial_(initial), constraints_(constraints) {}

  Bonds finish(Bonds uncut, int threads) {
    Bonds out;
    {
      const auto B = inverse_moments<Dim>(uncut, initial_.size(), threads);
      const std::vector<Point> S = surface_of(uncut, B, initial_.V0);
      const auto corrected = [&](const EndCorrection& by) { return with_end_correction(uncut, B, S, by); };
      out.mass = Dim == 2 ? initial_.V0 : corrected({.cells = 24, .on_faces = none});
      out.volume = corrected({.cells = Dim == 2 ? 24 : 15, .on_faces = -25});
      if constexpr (Dim == 2) out.face_terms = make_face_terms(scene_, initial_, uncut, S);
    }
    cut_at_clamps(std::move(uncut), out);
    out.B = inverse_moments<Dim>(out, initial_.size(), threads);
    return out;
  }

 private:
  /// Divisors: `on_faces` with `on_boundary` in 3D, else `cells` (THEORY.md, Volumes and masses).
  struct EndCorrection {
    double cells, on_faces;
  };
  static constexpr double none = std::numeric_limits<double>::infinity();

  bool is_on_faces(int i) const { return scene_.bodies[initial_.body[i]].on_boundary; }
  bool is_deformable(int i) const { return !is_rigid(constraints_[i]) || is_on_faces(i); }

  std::vector<double> with_end_correction(const Bonds& bonds, const std::vector<InverseMoment>& B,
                                          const std::vector<Point>& S, const EndCorrection& by) const {
    std::vector<double> V = initial_.V0;
    for (int i = 0; i < initial_.size(); ++i) {
      if (S[i] == Point{}) continue;
      const double share = Dim == 3 && is_on_faces(i) ? scene_.spacing * scene_.spacing / by.on_faces
                                                      : std::pow(initial_.V0[i], 2.0 / Dim) / by.cells;
      bonds.for_each(i, [&](int j, const ReferenceBond& bond) {
        const double change = share * vector_of<Dim>(S[i]).dot(vector_of<Dim>(gradient_of(B[i], bond)));
        V[j] += change;
        V[i] -= change;
      });
    }
    return V;
  }
  void cut_at_clamps(Bonds&& uncut, Bonds& out) const {
    const auto can_deform = [&](int i) { return is_deformable(i); };
    out.off_lattice = uncut.off_lattice, out.solid = uncut.solid;
    if (std::ranges::all_of(std::views::iota(0, initial_.size()), can_deform)) {
      out.begin.swap(uncut.begin), out.j.swap(uncut.j), out.rows.swap(uncut.rows), out.row.swap(uncut.row);
      return;
    }
    out.begin.push_back(0);
    for (int i = 0; i < initial_.size(); ++i) {
      const auto near = uncut.j.begin() + uncut.begin[i], end = uncut.j.begin() + uncut.begin[i + 1];
      const bool whole = out.solid && can_deform(i) && std::all_of(near, end, can_deform);
      if (out.solid) out.row.push_back(whole ? -1 : static_cast<int>(out.rows.size()));
      if (whole)
        out.j.insert(out.j.end(), near, end);
      else
        cut(uncut, i, out);
      out.begin.push_back(static_cast<int>(out.j.size()));
    }
  }
  /// Shortens bonds at clamps; a_ij grows to keep F_i exact.
  void cut(const Bonds& uncut, int i, Bonds& out) const {
    if (!is_deformable(i)) return;
    uncut.for_each(i, [&](int j, ReferenceBond bond) {
      const bool to_clamp = !is_deformable(j);
      if (to_clamp && bond.weight == 0) return;
      const double share = to_clamp ? share_before_clamp(i, bond.X) : 1;
      for (int k = 0; k < Dim; ++k) {
        bond.X[k] *= share;
        bond.area[k] /= share;
        if (Dim == 3 && out.off_lattice) bond.area[k] = single_precision(bond.area[k]);
      }
      out.j.push_back(j);
      out.rows.push_back(bond);
    });
  }
  double share_before_clamp(int i, const Point& X) const {
    const Body& body = scene_.bodies[initial_.body[i]];
    const auto is_in_clamp = [&](const Point& x) {
      if (body.clamped && body.clamped(x) != 0) return true;
      const int drive = last_that_holds(body.drives, x);
      return drive >= 0 && !ends_before_run(body.drives[drive], scene_);
    };
    double free = 0, inside = 1;
    for (int halving = 0; halving < 50; ++halving) {
      const double share = 0.5 * (free + inside);
      Point x = initial_.x[i];
      for (int k = 0; k < Dim; ++k) x[k] += share * X[k];
      (is_in_clamp(x) ? inside : free) = share;
    }
    constexpr double shortest = 0.4;  // in spacings; shorter bonds need shorter steps
    return std::min(1.0, std::max(inside, shortest * scene_.spacing / vector_of<Dim>(X).norm()));
  }

  const Scene& scene_;
  const InitialParticles& initial_;
  const Constraints& constraints_;
};

}  // namespace

ReferenceBond Bonds::in_solid(int i, int b) const {
  return solid->bond(i, j[b], static_cast<std::size_t>(b - begin[i]));
}

double modulus_of_bonds(int dim, const Elasticity& m) {
  return dim == 3 ? bond_modulus<3>(m.K, m.G) : bond_modulus<2>(m.K, m.G);
}

double modulus_of_bond(const Bonds& bonds, const InitialParticles& initial,
                       const std::vector<Elasticity>& materials, int i, int b) {
  const int other = bonds.is_rigid(bonds.j[b]) ? i : bonds.j[b];
  const double G_i = modulus_of_bonds(initial.dim, materials[initial.material[i]]),
               G_j = modulus_of_bonds(initial.dim, materials[initial.material[other]]);
  return 2 * G_i * G_j / (G_i + G_j);
}

std::vector<Point> surface(const Bonds& bonds) { return surface_of(bonds, bonds.B, bonds.volume); }

Bonds make_bonds(const Scene& scene, const InitialParticles& initial, Constraints constraints, double h,
                 int threads) {
  Bonds bonds = scene.dim == 3
                    ? BondFinisher<3>(scene, initial, constraints)
                          .finish(solid_bonds(initial, constraints, scene.spacing, h, threads), threads)
                    : BondFinisher<2>(scene, initial, constraints)
                          .finish(layout_bonds(initial, constraints, scene.spacing, h, threads), threads);
  bonds.constraints = std::move(constraints);
  return bonds;
}

}  // namespace taut
