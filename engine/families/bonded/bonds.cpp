#include "engine/families/bonded/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <Eigen/LU>

#include "engine/core/least_squares.hpp"
#include "engine/core/parallel.hpp"
#include "engine/families/bonded/balance.hpp"
#include "engine/neighbors/initial_neighbors.hpp"

namespace taut {
namespace {

/// The products e_a e_b e_c e_d of the components of unit vectors: of bonds, and what they should add up to.
template <int Dim>
class Moments {
 public:
  Moments() {
    std::array<int, Dim> powers{};
    fill(powers, 0, 4);
    for (int m = 0; m < count; ++m) target_[m] = isotropic(powers_[m]);
  }

  /// Makes of the weights w of the bonds X those of right moments that are nearest to them, and says whether
  /// there are any that are not negative. The same where they are right to begin with.
  bool make_right(const std::vector<Eigen::Vector<double, Dim>>& X, std::vector<double>& w) const {
    std::vector<Vector> M(X.size());
    for (std::size_t b = 0; b < X.size(); ++b) M[b] = of(X[b].normalized());
    if (Dim == 3 && right(M, w)) return true;
    correct(M, w);
    return right(M, w);
  }

 private:
  static constexpr int count = Dim == 2 ? 5 : 15;
  using Vector = Eigen::Vector<double, count>;

  void fill(std::array<int, Dim>& powers, int axis, int left) {
    powers[axis] = left;
    if (axis == Dim - 1) return powers_.push_back(powers);
    for (; powers[axis] >= 0; --powers[axis]) fill(powers, axis + 1, left - powers[axis]);
  }
  /// δ_ab δ_cd + δ_ac δ_bd + δ_ad δ_bc: 3 for e_x⁴, 1 for e_x² e_y², 0 with an odd power.
  static double isotropic(const std::array<int, Dim>& powers) {
    double value = 1;
    for (int p : powers) value *= p % 2 == 1 ? 0 : (p == 4 ? 3 : 1);
    return value;
  }
  Vector of(const Eigen::Vector<double, Dim>& e) const {
    std::array<std::array<double, 5>, Dim> power;
    for (int k = 0; k < Dim; ++k)
      power[k] = {1, e[k], e[k] * e[k], e[k] * e[k] * e[k], e[k] * e[k] * e[k] * e[k]};
    Vector moments;
    for (int m = 0; m < count; ++m) {
      moments[m] = 1;
      for (int k = 0; k < Dim; ++k) moments[m] *= power[k][powers_[m][k]];
    }
    return moments;
  }
  Vector missing(const std::vector<Vector>& M, const std::vector<double>& w) const {
    Vector sum = target_;
    for (std::size_t b = 0; b < M.size(); ++b) sum -= w[b] * M[b];
    return sum;
  }
  bool right(const std::vector<Vector>& M, const std::vector<double>& w) const {
    return missing(M, w).cwiseAbs().maxCoeff() < 1e-9;
  }
  /// w = ω ∘ (1 + Mᵀ α) with M w = target, the smallest such change of ω. Weights that come out negative are
  /// set to 0 and the others solved for again.
  void correct(const std::vector<Vector>& M, std::vector<double>& omega) const {
    std::vector<double> w(omega.size());
    for (std::size_t round = 0; round <= omega.size(); ++round) {
      Eigen::Matrix<double, count, count> A = Eigen::Matrix<double, count, count>::Zero();
      for (std::size_t b = 0; b < M.size(); ++b)
        for (int k = 0; k < count; ++k) A.col(k) += omega[b] * M[b][k] * M[b];
      const Vector alpha = least_squares(A, missing(M, omega)).x;
      bool negative = false;
      for (std::size_t b = 0; b < M.size(); ++b) {
        w[b] = omega[b] + omega[b] * M[b].dot(alpha);
        negative = negative || w[b] < 0;
      }
      if (!negative) return omega.swap(w);
      for (std::size_t b = 0; b < M.size(); ++b)
        if (w[b] < 0) omega[b] = 0;
    }
  }

  std::vector<std::array<int, Dim>> powers_;
  Vector target_;
};

template <int Dim>
Point point(const Eigen::Vector<double, Dim>& v) {
  Point p{};
  for (int k = 0; k < Dim; ++k) p[k] = v[k];
  return p;
}

/// To 2^-36, far finer than the moments are right: the last bits may differ in a mirror image.
double rounded(double weight) { return std::ldexp(std::round(std::ldexp(weight, 36)), -36); }

/// w of a bond of the cubic lattice, `r` in spacings: along an axis, across a face, across the cube. With
/// (½ + 4t/9, 1 − 8t/9, t) of any t the fourth moments are isotropic; t = 3/8 has the least error (of t = 0,
/// whose bonds are 18, it is about twice as large).
double lattice_weight(double r) {
  constexpr double t = 3.0 / 8;
  return r < 1.2 ? 0.5 + 4 * t / 9 : r < 1.58 ? 1 - 8 * t / 9 : t;
}

/// Makes the bonds step by step; what each step needs was made by the ones before.
template <int Dim>
class BondMaker {
 public:
  BondMaker(const Scene& scene, const InitialParticles& initial, double h, int threads)
      : scene_(scene),
        initial_(initial),
        h_(h),
        threads_(threads),
        least_reach_(initial.first.size() - 1, least_bond_reach),
        near_(initial_neighbors(initial, (Dim == 2 ? greatest_bond_reach : least_bond_reach) * h, threads)) {}

  Bonds make() {
    if constexpr (Dim == 2)
      make_of_layout();
    else
      make_of_lattice();
    out_.mass = Dim == 2 ? initial_.V0 : with_end_correction({.cells = 24, .on_faces = none});
    out_.volume = with_end_correction({.cells = Dim == 2 ? 24 : 15, .on_faces = -25});
    cut_at_clamp();
    set_gradients();
    return std::move(out_);
  }

 private:
  /// Of (V_i w_ij + V_j w_ji)/V_i, which is about 2; of w_ij alone at a clamp.
  static constexpr double least_strength = 0.4;

  /// dp² is divided by: of particles in the middle of cells, and of those that stand on faces.
  struct EndCorrection {
    double cells, on_faces;
  };
  static constexpr double none = std::numeric_limits<double>::infinity();
  static constexpr double not_asked = -1;

  using Place = Eigen::Vector<double, Dim>;
  using Square = Eigen::Matrix<double, Dim, Dim>;
  static Place column(const Point& p) { return Eigen::Map<const Place>(p.data()); }
  /// X_ij, m; in 3D to 2^-40 of a spacing, so that the bonds of a lattice are the same wherever they are.
  Place between(int i, int j) const {
    Place X = column(initial_.x[j]) - column(initial_.x[i]);
    if constexpr (Dim == 3)
      for (double& x : X)
        x = std::ldexp(std::round(std::ldexp(x / scene_.spacing, 40)), -40) * scene_.spacing + 0.0;
    return X;
  }
  /// a_ij over X_ij, of the spacing over r: in 3D of those on the axes of the lattice alone.
  static double area_share(double per_r) {
    if constexpr (Dim == 3) return per_r > 0.83 ? 1 : 0;
    const double squared = per_r * per_r, to_4 = squared * squared;
    return to_4 * to_4;
  }

  void make_of_lattice() {
    choose_on_lattice();
    set_ends();
    set_gradients();
    help_who_lack_an_axis();
  }
  void make_of_layout() {
    make_balanced();
    bool wide = false;
    for (const int body : with_pair_below(least_strength)) least_reach_[body] = wide_bond_reach, wide = true;
    if (wide) make_balanced();
    for (const int body : with_pair_below(-least_strength))
      for (int b = out_.begin[initial_.first[body]]; b < out_.begin[initial_.first[body + 1]]; ++b)
        out_.weight[b] = unbalanced_[b];
  }
  void make_balanced() {
    choose();
    set_ends();
    set_gradients();
    balance_areas(initial_, out_, threads_);
    set_gradients();
    unbalanced_ = out_.weight;
    balance_weights(initial_, out_, threads_);
  }
  void choose();
  void choose_on_lattice();
  void set_ends();
  void set_gradients();
  std::vector<int> with_pair_below(double least) const;
  void straighten(int i);
  void help_who_lack_an_axis();
  std::vector<double> with_end_correction(const EndCorrection& correction) const;
  bool on_faces(int i) const { return scene_.bodies[initial_.body[i]].on_boundary; }
  bool deforms(int i) const { return !initial_.held[i] || (Dim == 3 && on_faces(i)); }
  void cut_at_clamp();
  double share_before_clamp(int i, const Point& X) const;

  const Scene& scene_;
  const InitialParticles& initial_;
  double h_;
  int threads_;
  std::vector<double> least_reach_;  // [body] of the bonds, in h
  NeighborLists near_;               // by id
  std::vector<double> asked_;        // [pair of near_] w_ij
  std::vector<double> unbalanced_;   // weights before they were balanced
  Bonds out_;
};

/// Which others each particle asks for, and with which weights.
template <int Dim>
void BondMaker<Dim>::choose() {
  const Moments<Dim> moments;
  asked_.assign(near_.j.size(), not_asked);
  parallel_for(initial_.size(), threads_, [&](int i) {
    const std::span<const int> near = near_[i];
    std::vector<Place> X;
    std::vector<double> w;
    std::vector<std::size_t> pairs;
    const double least = least_reach_[initial_.body[i]];
    for (double reach = least; reach <= greatest_bond_reach; reach += 0.125) {
      X.clear(), w.clear(), pairs.clear();
      for (std::size_t k = 0; k < near.size(); ++k) {
        const Place one = column(initial_.x[near[k]]) - column(initial_.x[i]);
        if (!(one.norm() < reach * h_ * (1 - 1e-9))) continue;
        X.push_back(one);
        w.push_back(initial_.V0[near[k]] / (Dim == 2 ? one.squaredNorm() : one.squaredNorm() * one.norm()));
        pairs.push_back(near_.begin[i] + k);
      }
      const bool right = moments.make_right(X, w);
      if (!right && reach > least) continue;  // the first choice stands if none is right
      std::fill_n(asked_.begin() + near_.begin[i], near.size(), not_asked);
      for (std::size_t b = 0; b < pairs.size(); ++b) asked_[pairs[b]] = rounded(w[b]);
      if (right) break;
    }
  });
}

/// The 26 nearest of a cubic lattice. A particle that has them all asks for right moments, which it finds as
/// they are on a lattice; of another one a missing neighbour is a missing bond and nothing is reweighted.
template <int Dim>
void BondMaker<Dim>::choose_on_lattice() {
  constexpr std::size_t whole = 26;
  const Moments<Dim> moments;
  asked_.resize(near_.j.size());
  parallel_for(initial_.size(), threads_, [&](int i) {
    std::vector<Place> X;
    std::vector<double> w;
    for (const int j : near_[i]) {
      X.push_back(column(initial_.x[j]) - column(initial_.x[i]));
      w.push_back(lattice_weight(X.back().norm() / scene_.spacing));
    }
    if (X.size() == whole) moments.make_right(X, w);
    for (std::size_t b = 0; b < w.size(); ++b) asked_[near_.begin[i] + b] = rounded(w[b]);
  });
}

/// Every bond that one of its two ends asked for, with the particles for its ends.
template <int Dim>
void BondMaker<Dim>::set_ends() {
  const auto asked = [&](std::size_t pair, std::size_t back) {
    return asked_[pair] != not_asked || asked_[back] != not_asked;
  };
  const int n = initial_.size();
  std::vector<std::size_t> back(near_.j.size());
  out_ = {};
  out_.begin.assign(n + 1, 0);
  parallel_for(n, threads_, [&](int i) {
    for (std::size_t pair = near_.begin[i]; pair < near_.begin[i + 1]; ++pair) {
      back[pair] = near_.find(near_.j[pair], i);
      out_.begin[i + 1] += asked(pair, back[pair]);
    }
  });
  std::partial_sum(out_.begin.begin(), out_.begin.end(), out_.begin.begin());
  out_.j.resize(out_.begin[n]);
  out_.weight.resize(out_.j.size());
  out_.X.resize(out_.j.size());
  out_.area.resize(out_.j.size());
  parallel_for(n, threads_, [&](int i) {
    int b = out_.begin[i];
    for (std::size_t pair = near_.begin[i]; pair < near_.begin[i + 1]; ++pair) {
      if (!asked(pair, back[pair])) continue;
      const int j = near_.j[pair];
      const Place X = between(i, j);
      out_.j[b] = j;
      out_.weight[b] = asked_[pair] == not_asked ? 0 : asked_[pair];
      out_.X[b] = point<Dim>(X);
      out_.area[b] = point<Dim>(area_share(scene_.spacing / X.norm()) * X);
      ++b;
    }
  });
}

template <int Dim>
void BondMaker<Dim>::set_gradients() {
  out_.gradient.assign(out_.j.size(), Point{});
  out_.B.assign(initial_.size(), {});
  parallel_for(initial_.size(), threads_, [&](int i) {
    Square A = Square::Zero();
    for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b)
      A += column(out_.area[b]) * column(out_.X[b]).transpose();
    const double scale = std::pow(A.trace() / Dim, Dim);
    if (!(A.determinant() > 1e-6 * scale)) return;
    const Square B = A.inverse();
    for (int k = 0; k < Dim; ++k) out_.B[i][k] = point<Dim>(B.col(k));
    for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b)
      out_.gradient[b] = point<Dim>(B * column(out_.area[b]));
  });
}

/// A particle that has no neighbour on one of the axes, as the tips of round bodies, takes the gradient from
/// all its bonds, and so do their other ends of them.
template <int Dim>
void BondMaker<Dim>::help_who_lack_an_axis() {
  bool helped = false;
  for (int i = 0; i < initial_.size(); ++i) {
    if (out_.B[i][0][0] > 0) continue;
    helped = true;
    for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b) {
      const int j = out_.j[b];
      const int back =
          static_cast<int>(std::find(out_.j.begin() + out_.begin[j], out_.j.end(), i) - out_.j.begin());
      const Place a = std::pow(scene_.spacing / column(out_.X[b]).norm(), 8) * column(out_.X[b]);
      out_.area[b] = point<Dim>(a);
      out_.area[back] = point<Dim>(-a);
    }
  }
  if (helped) set_gradients();
}

/// The bodies whose balance has left a pair of particles less than this strength.
template <int Dim>
std::vector<int> BondMaker<Dim>::with_pair_below(double least) const {
  std::vector<int> bodies;
  for (int i = 0; i < initial_.size(); ++i) {
    if (initial_.held[i] || (!bodies.empty() && bodies.back() == initial_.body[i])) continue;
    for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b) {
      const int j = out_.j[b];
      const int* last = out_.j.data() + out_.begin[j + 1];
      const int* back = std::find(last - (out_.begin[j + 1] - out_.begin[j]), last, i);
      const double of_other = initial_.V0[j] / initial_.V0[i] * out_.weight[back - out_.j.data()];
      const bool enough = initial_.held[j]
                              ? out_.weight[b] >= std::min(least, 0.0)  // of others there are more
                              : out_.weight[b] + of_other >= least;
      if (enough) continue;
      bodies.push_back(initial_.body[i]);
      break;
    }
  }
  return bodies;
}

/// V_k += Σ_j D_j²/divisor S_j · (g_jk − δ_jk Σ_l g_jl): S_j = Σ_i (V_i g_ij − V_j g_ji) is the surface that
/// belongs to particle j, 0 inside; D³ is its volume, or where it stands on a face that of a whole cell.
template <int Dim>
std::vector<double> BondMaker<Dim>::with_end_correction(const EndCorrection& correction) const {
  const std::vector<Point> S = surface(out_, initial_.V0);
  std::vector<double> V = initial_.V0;
  for (int j = 0; j < initial_.size(); ++j) {
    const double share = Dim == 3 && on_faces(j) ? scene_.spacing * scene_.spacing / correction.on_faces
                                                 : std::pow(initial_.V0[j], 2.0 / Dim) / correction.cells;
    for (int b = out_.begin[j]; b < out_.begin[j + 1]; ++b) {
      const double change = share * column(S[j]).dot(column(out_.gradient[b]));
      V[out_.j[b]] += change;
      V[j] -= change;
    }
  }
  return V;
}

/// Share of the way X from free particle i that lies before the held region.
template <int Dim>
double BondMaker<Dim>::share_before_clamp(int i, const Point& X) const {
  const Expression& held = scene_.bodies[initial_.body[i]].held;
  double free = 0, inside = 1;
  for (int halving = 0; halving < 50; ++halving) {
    const double share = 0.5 * (free + inside);
    Point x = initial_.x[i];
    for (int k = 0; k < Dim; ++k) x[k] += share * X[k];
    (held(x) != 0 ? inside : free) = share;
  }
  constexpr double shortest = 0.4;  // in spacings: a shorter bond would ask for shorter steps
  return std::min(1.0, std::max(inside, shortest * scene_.spacing / column(X).norm()));
}

/// Takes away the bonds of held particles and shortens those that lead to them. Their a_ij stay as they are
/// in 2D; in 3D they grow as much, so that F is what it would be had the particle behind the face gone on
/// linearly, and a uniform stress leaves no force on the particles before it. Particles that stand on the
/// face of a clamp keep theirs: the half of their cell before it is strained like any other.
template <int Dim>
void BondMaker<Dim>::cut_at_clamp() {
  bool all_deform = true;
  for (int i = 0; i < initial_.size() && all_deform; ++i) all_deform = deforms(i);
  if (all_deform) return;
  Bonds cut;
  cut.begin.push_back(0);
  cut.volume = std::move(out_.volume);
  cut.mass = std::move(out_.mass);
  for (int i = 0; i < initial_.size(); ++i) {
    for (int b = out_.begin[i]; b < out_.begin[i + 1] && deforms(i); ++b) {
      const bool to_clamp = !deforms(out_.j[b]);
      if (to_clamp && out_.weight[b] == 0) continue;
      const double share = to_clamp ? share_before_clamp(i, out_.X[b]) : 1;
      cut.j.push_back(out_.j[b]);
      cut.weight.push_back(out_.weight[b]);
      cut.X.push_back(point<Dim>(share * column(out_.X[b])));
      cut.area.push_back(Dim == 2 ? out_.area[b] : point<Dim>(1 / share * column(out_.area[b])));
    }
    cut.begin.push_back(static_cast<int>(cut.j.size()));
  }
  out_ = std::move(cut);
  if constexpr (Dim == 2)
    for (int i = 0; i < initial_.size(); ++i) straighten(i);
}

/// Where a_ij has a part across X_ij, a shortened X makes Σ_j a_ij ⊗ X_ij skew. Bonds into the clamp, which
/// have no other side to agree with, take that back.
template <int Dim>
void BondMaker<Dim>::straighten(int i) {
  double skew = 0, into_clamp = 0;
  for (int b = out_.begin[i]; b < out_.begin[i + 1]; ++b) {
    const Point &a = out_.area[b], &X = out_.X[b];
    skew += a[0] * X[1] - a[1] * X[0];
    if (initial_.held[out_.j[b]]) into_clamp += X[0] * X[0] + X[1] * X[1];
  }
  for (int b = out_.begin[i]; b < out_.begin[i + 1] && into_clamp > 0; ++b) {
    if (!initial_.held[out_.j[b]]) continue;
    out_.area[b][0] += skew / into_clamp * -out_.X[b][1];
    out_.area[b][1] += skew / into_clamp * out_.X[b][0];
  }
}

}  // namespace

std::vector<Point> surface(const Bonds& bonds, const std::vector<double>& V) {
  std::vector<Point> S(V.size());
  for (std::size_t i = 0; i < S.size(); ++i) {
    for (int b = bonds.begin[i]; b < bonds.begin[i + 1]; ++b) {
      for (std::size_t k = 0; k < 3; ++k) {
        S[static_cast<std::size_t>(bonds.j[b])][k] += V[i] * bonds.gradient[b][k];
        S[i][k] -= V[i] * bonds.gradient[b][k];
      }
    }
  }
  return S;
}

Bonds make_bonds(const Scene& scene, const InitialParticles& initial, double h, int threads) {
  return scene.dim == 3 ? BondMaker<3>(scene, initial, h, threads).make()
                        : BondMaker<2>(scene, initial, h, threads).make();
}

}  // namespace taut
