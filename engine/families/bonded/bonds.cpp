#include "engine/families/bonded/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "engine/families/bonded/bond_gradients.hpp"
#include "engine/families/bonded/layout_bonds.hpp"
#include "engine/families/bonded/solid_bonds.hpp"

namespace taut {
namespace {

/// c |X|²/V0 of bonds.hpp, Faces.
double lacking_along_free_face(const Material& material) {
  const double G = material.shear_modulus(), lambda = material.bulk_modulus() - 2.0 / 3 * G,
               thinner = lambda / (lambda + 2 * G);
  return 1.1 * 5 / 16 * (1.5 - thinner - 1.5 * thinner * thinner);
}

/// Which neighbour of i lies in the direction d, −1 if there is none.
int neighbor_towards(const Bonds& bonds, int i, const Eigen::Vector2d& d) {
  constexpr double nearly = 0.99;  // the cosine
  int found = -1;
  bonds.for_each(i, [&](int j, const Bond& bond) {
    const Eigen::Vector2d X = vector_of<2>(bond.X);
    if (X.dot(d) > nearly * X.norm() * d.norm()) found = j;
  });
  return found;
}

/// Makes of bonds as if nothing were held those that there are.
template <int Dim>
class BondMaker {
 public:
  BondMaker(const Scene& scene, const InitialParticles& initial, int threads)
      : scene_(scene), initial_(initial), threads_(threads) {}

  template <class AnyBonds>
  Bonds make(AnyBonds uncut) {
    Bonds out;
    {
      const auto B = inverse_moments<Dim>(uncut, initial_.size(), threads_);
      const std::vector<Point> S = surface_of(uncut, B, initial_.V0);
      const auto corrected = [&](const EndCorrection& correction) {
        return with_end_correction(uncut, B, S, correction);
      };
      out.mass = Dim == 2 ? initial_.V0 : corrected({.cells = 24, .on_faces = none});
      out.volume = corrected({.cells = Dim == 2 ? 24 : 15, .on_faces = -25});
      if constexpr (Dim == 2) out.face_terms = face_terms(uncut, S);
    }
    cut_at_clamp(std::move(uncut), out);
    out.B = inverse_moments<Dim>(out, initial_.size(), threads_);
    return out;
  }

 private:
  /// dp² is divided by: of particles in the middle of cells, and of those that stand on faces.
  struct EndCorrection {
    double cells, on_faces;
  };
  static constexpr double none = std::numeric_limits<double>::infinity();

  bool on_faces(int i) const { return scene_.bodies[initial_.body[i]].on_boundary; }
  bool deforms(int i) const { return !initial_.held[i] || on_faces(i); }

  template <class AnyBonds>
  std::vector<double> with_end_correction(const AnyBonds& bonds, const std::vector<std::array<Point, 3>>& B,
                                          const std::vector<Point>& S, const EndCorrection& correction) const;
  std::vector<FaceTerm> face_terms(const Bonds& uncut, const std::vector<Point>& S) const;
  void cut_at_clamp(Bonds&& uncut, Bonds& out) const;
  void cut_at_clamp(SolidBonds&& uncut, Bonds& out) const;
  template <class AnyBonds>
  void cut(const AnyBonds& uncut, int i, Bonds& out) const;
  double share_before_clamp(int i, const Point& X) const;

  const Scene& scene_;
  const InitialParticles& initial_;
  int threads_;
};

/// V_k += Σ_j D_j²/divisor S_j · (g_jk − δ_jk Σ_l g_jl): S_j = Σ_i (V_i g_ij − V_j g_ji) is the surface that
/// belongs to particle j, 0 inside; D³ is its volume, or where it stands on a face that of a whole cell.
template <int Dim>
template <class AnyBonds>
std::vector<double> BondMaker<Dim>::with_end_correction(const AnyBonds& bonds,
                                                        const std::vector<std::array<Point, 3>>& B,
                                                        const std::vector<Point>& S,
                                                        const EndCorrection& correction) const {
  std::vector<double> V = initial_.V0;
  for (int i = 0; i < initial_.size(); ++i) {
    if (S[i] == Point{}) continue;
    const double share = Dim == 3 && on_faces(i) ? scene_.spacing * scene_.spacing / correction.on_faces
                                                 : std::pow(initial_.V0[i], 2.0 / Dim) / correction.cells;
    bonds.for_each(i, [&](int j, const Bond& bond) {
      const double change = share * vector_of<Dim>(S[i]).dot(vector_of<Dim>(gradient_of(B[i], bond)));
      V[j] += change;
      V[i] -= change;
    });
  }
  return V;
}

/// Of particles that have five of the eight nearest, as a straight face has, away from other materials.
template <int Dim>
std::vector<FaceTerm> BondMaker<Dim>::face_terms(const Bonds& uncut, const std::vector<Point>& S) const {
  constexpr int inside = 8, at_face = 5;
  const auto count = [&](int i) { return uncut.begin[i + 1] - uncut.begin[i]; };
  const auto alike = [&](int i) {
    bool all = true;
    uncut.for_each(i, [&](int j, const Bond&) { all = all && initial_.material[j] == initial_.material[i]; });
    return all;
  };
  std::vector<bool> of_nearest(scene_.bodies.size(), true);
  for (int i = 0; i < initial_.size(); ++i)
    if (count(i) > inside) of_nearest[initial_.body[i]] = false;
  std::vector<FaceTerm> terms;
  for (int i = 0; i < initial_.size(); ++i) {
    if (!of_nearest[initial_.body[i]] || count(i) != at_face) continue;
    const Eigen::Vector2d inwards = -vector_of<2>(S[i]);
    const int second = neighbor_towards(uncut, i, inwards),
              third = second < 0 ? -1 : neighbor_towards(uncut, second, inwards);
    if (third < 0 || !alike(i) || !alike(second) || !alike(third)) continue;
    const Eigen::Vector2d X = vector_of<2>(initial_.x[second]) - vector_of<2>(initial_.x[i]);
    const Material& material = scene_.materials[initial_.material[i]];
    const double c = lacking_along_free_face(material) * initial_.V0[i] / X.squaredNorm();
    const Point t{-X[1], X[0]};
    terms.push_back({i, t, -c});
    terms.push_back({second, t, 1.2 * c});
    terms.push_back({third, t, -0.2 * c});
  }
  std::ranges::stable_sort(terms, {}, &FaceTerm::i);
  return terms;
}

/// Share of the way X from free particle i that lies before the region that is held or driven to the end.
template <int Dim>
double BondMaker<Dim>::share_before_clamp(int i, const Point& X) const {
  const Body& body = scene_.bodies[initial_.body[i]];
  const auto in_clamp = [&](const Point& x) {
    if (body.held && body.held(x) != 0) return true;
    const int drive = last_that_holds(body.drives, x);
    return drive >= 0 && !lets_go(body.drives[drive], scene_);
  };
  double free = 0, inside = 1;
  for (int halving = 0; halving < 50; ++halving) {
    const double share = 0.5 * (free + inside);
    Point x = initial_.x[i];
    for (int k = 0; k < Dim; ++k) x[k] += share * X[k];
    (in_clamp(x) ? inside : free) = share;
  }
  constexpr double shortest = 0.4;  // in spacings: a shorter bond would ask for shorter steps
  return std::min(1.0, std::max(inside, shortest * scene_.spacing / vector_of<Dim>(X).norm()));
}

/// Takes away the bonds of held particles and shortens those that lead to them. Their a_ij grow as much, so that F is
/// what it would be had the particle behind the face gone on linearly, and a uniform stress leaves no force on the
/// particles before it. Particles that stand on the face of a clamp keep theirs: the half of their cell before it is
/// strained like any other.
template <int Dim>
template <class AnyBonds>
void BondMaker<Dim>::cut(const AnyBonds& uncut, int i, Bonds& out) const {
  if (!deforms(i)) return;
  uncut.for_each(i, [&](int j, Bond bond) {
    const bool to_clamp = !deforms(j);
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

template <int Dim>
void BondMaker<Dim>::cut_at_clamp(Bonds&& uncut, Bonds& out) const {
  out.off_lattice = uncut.off_lattice;
  bool all_deform = true;
  for (int i = 0; i < initial_.size() && all_deform; ++i) all_deform = deforms(i);
  if (all_deform) {
    out.begin.swap(uncut.begin), out.j.swap(uncut.j), out.rows.swap(uncut.rows);
    return;
  }
  out.begin.push_back(0);
  for (int i = 0; i < initial_.size(); ++i) {
    cut(uncut, i, out);
    out.begin.push_back(static_cast<int>(out.j.size()));
  }
}

template <int Dim>
void BondMaker<Dim>::cut_at_clamp(SolidBonds&& uncut, Bonds& out) const {
  out.off_lattice = uncut.geometry().off_lattice;
  out.begin.push_back(0);
  for (int i = 0; i < initial_.size(); ++i) {
    const std::span<const int> near = uncut.near(i);
    const bool whole = deforms(i) && std::ranges::all_of(near, [&](int j) { return deforms(j); });
    out.row.push_back(whole ? -1 : static_cast<int>(out.rows.size()));
    if (whole)
      out.j.insert(out.j.end(), near.begin(), near.end());
    else
      cut(uncut, i, out);
    out.begin.push_back(static_cast<int>(out.j.size()));
  }
  out.solid = std::make_shared<const SolidGeometry>(std::move(uncut).take_geometry());
}

}  // namespace

Bond Bonds::in_solid(int i, int b) const {
  return solid->bond(i, j[b], static_cast<std::size_t>(b - begin[i]));
}

std::vector<Point> surface(const Bonds& bonds, const std::vector<double>& V) {
  return surface_of(bonds, bonds.B, V);
}

Bonds make_bonds(const Scene& scene, const InitialParticles& initial, double h, int threads) {
  if (scene.dim == 3)
    return BondMaker<3>(scene, initial, threads).make(SolidBonds(initial, scene.spacing, h, threads));
  return BondMaker<2>(scene, initial, threads).make(layout_bonds(initial, scene.spacing, h, threads));
}

}  // namespace taut
