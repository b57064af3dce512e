#include "engine/families/bonded/face_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/families/bonded/bond_gradients.hpp"
#include "engine/families/bonded/solid_bonds.hpp"

namespace taut {
namespace {

template <int Dim>
using V = Eigen::Vector<double, Dim>;

/// ν′ = λ/(λ + 2G)
double thinner(const Material& material) {
  const double G = material.shear_modulus(), lambda = material.bulk_modulus() - 2.0 / 3 * G;
  return lambda / (lambda + 2 * G);
}

/// What a face lacks along d, or of the areas across it.
struct Lacking {
  Point d;
  std::array<double, 3> layers;  // weights, from the outermost one on
  bool across = false;
};

struct Neighbor {
  int j = -1;
  Point X{};
};

/// The neighbour of i that lies in the direction d, if there is one.
template <int Dim, class AnyBonds>
Neighbor neighbor_towards(const AnyBonds& bonds, int i, const V<Dim>& d) {
  constexpr double nearly = 0.99;  // the cosine
  Neighbor found;
  bonds.for_each(i, [&](int j, const Bond& bond) {
    const V<Dim> X = vector_of<Dim>(bond.X);
    if (X.dot(d) > nearly * X.norm() * d.norm()) found = {j, bond.X};
  });
  return found;
}

int count(const Bonds& bonds, int i) { return bonds.begin[i + 1] - bonds.begin[i]; }
int count(const SolidBonds& bonds, int i) { return static_cast<int>(bonds.near(i).size()); }

template <int Dim, class AnyBonds>
class FaceTerms {
 public:
  FaceTerms(const Scene& scene, const InitialParticles& initial, const AnyBonds& uncut)
      : scene_(scene), initial_(initial), uncut_(uncut), has_faces_(scene.bodies.size(), true) {
    for (int i = 0; i < initial.size(); ++i)
      if (count(uncut, i) > inside || scene.bodies[initial.body[i]].on_boundary)
        has_faces_[initial.body[i]] = false;
  }

  /// At the face to which particle i may belong, whose surface is S.
  void add(int i, const Point& S) {
    if (!has_faces_[initial_.body[i]] || S == Point{} || count(uncut_, i) != at_face) return;
    const V<Dim> inwards = Dim == 2 ? V<Dim>(-vector_of<Dim>(S)) : middle_of_neighbors(i);
    const Neighbor second = neighbor_towards<Dim>(uncut_, i, inwards);
    const int third = second.j < 0 ? -1 : neighbor_towards<Dim>(uncut_, second.j, inwards).j;
    if (third < 0 || !alike(i) || !alike(second.j) || !alike(third)) return;
    if (Dim == 3 && !far_from_edges(i, second.X)) return;
    for (const Lacking& lacking : of_face(i, second.X)) {
      terms_.push_back({i, lacking.d, lacking.layers[0], lacking.across});
      terms_.push_back({second.j, lacking.d, lacking.layers[1], lacking.across});
      terms_.push_back({third, lacking.d, lacking.layers[2], lacking.across});
    }
  }
  std::vector<FaceTerm> sorted() && {
    std::ranges::stable_sort(terms_, {}, &FaceTerm::i);
    return std::move(terms_);
  }

 private:
  static constexpr int inside = Dim == 2 ? 8 : 26, at_face = Dim == 2 ? 5 : 17;

  V<Dim> middle_of_neighbors(int i) const {
    V<Dim> sum = V<Dim>::Zero();
    uncut_.for_each(i, [&](int, const Bond& bond) { sum += vector_of<Dim>(bond.X); });
    return sum;
  }
  /// Away from other materials?
  bool alike(int i) const {
    bool all = true;
    uncut_.for_each(i,
                    [&](int j, const Bond&) { all = all && initial_.material[j] == initial_.material[i]; });
    return all;
  }
  /// Is every edge of the face at least as far as the one that lies behind the body? X leads to the second layer.
  bool far_from_edges(int i, const Point& X) const {
    const V<Dim> across = vector_of<Dim>(X);
    double thick = across.norm();
    for (int j = i; (j = neighbor_towards<Dim>(uncut_, j, across).j) >= 0;) thick += across.norm();
    bool far = true;
    uncut_.for_each(i, [&](int, const Bond& bond) {
      const V<Dim> d = vector_of<Dim>(bond.X);
      if (bond.area == Point{} || !is_along_face(d, across)) return;  // the four on the axes are enough
      int j = i;
      for (double way = 0; way < thick && far; way += d.norm()) {
        j = neighbor_towards<Dim>(uncut_, j, d).j;
        far = j >= 0 && count(uncut_, j) == at_face;
      }
    });
    return far;
  }
  static bool is_along_face(const V<Dim>& d, const V<Dim>& across) {
    return std::abs(d.dot(across)) < 0.01 * d.norm() * across.norm();
  }
  /// X leads to the second layer.
  std::vector<Lacking> of_face(int i, const Point& X) const {
    const double nu = thinner(scene_.materials[initial_.material[i]]);
    const V<Dim> across = vector_of<Dim>(X);
    if constexpr (Dim == 2) {
      const double c = 1.1 * 5 / 16 * (1.5 - nu - 1.5 * nu * nu) * initial_.V0[i] / across.squaredNorm();
      return {{{-X[1], X[0]}, {-c, 1.2 * c, -0.2 * c}}};
    }
    const double c = (1 - 5 * nu) * (1 + 3 * nu) / 40;
    std::vector<Lacking> lacking{{X, {-2 * c, 3 * c, -c}, true}};
    uncut_.for_each(i, [&](int, const Bond& bond) {
      if (is_along_face(vector_of<Dim>(bond.X), across))
        lacking.push_back({bond.X, {-1.0 / 16, 13.0 / 120, -11.0 / 240}});  // twice along each line
    });
    return lacking;
  }

  const Scene& scene_;
  const InitialParticles& initial_;
  const AnyBonds& uncut_;
  std::vector<bool> has_faces_;  // [body]
  std::vector<FaceTerm> terms_;
};

template <int Dim, class AnyBonds>
std::vector<FaceTerm> terms_of(const Scene& scene, const InitialParticles& initial, const AnyBonds& uncut,
                               const std::vector<Point>& surface) {
  FaceTerms<Dim, AnyBonds> terms(scene, initial, uncut);
  for (int i = 0; i < initial.size(); ++i) terms.add(i, surface[i]);
  return std::move(terms).sorted();
}

}  // namespace

std::vector<FaceTerm> face_terms(const Scene& scene, const InitialParticles& initial, const Bonds& uncut,
                                 const std::vector<Point>& surface) {
  return terms_of<2>(scene, initial, uncut, surface);
}

std::vector<FaceTerm> face_terms(const Scene& scene, const InitialParticles& initial, const SolidBonds& uncut,
                                 const std::vector<Point>& surface) {
  if (uncut.geometry().off_lattice) return {};
  return terms_of<3>(scene, initial, uncut, surface);
}

}  // namespace taut
