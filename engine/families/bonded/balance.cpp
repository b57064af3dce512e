#include "engine/families/bonded/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

namespace taut {
namespace {

using Vector = Eigen::Vector2d;
using Rows = Eigen::SparseMatrix<double>;

/// Of the force over that of a bond at a strain of 1: what is left of it is round-off.
constexpr double balanced = 1e-12;

Vector vector(const Point& p) { return {p[0], p[1]}; }

/// x of the least Σ (Δx)²/ω with A x = b, from x. Rows of A may depend on each other. Conjugate gradients for
/// A Ω Aᵀ, with its own Cholesky factor, a little off where it is singular, to lead them.
Eigen::VectorXd least_change(const Rows& A, const Eigen::VectorXd& b, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& omega) {
  Eigen::VectorXd r = b - A * x;
  if (r.size() == 0 || r.cwiseAbs().maxCoeff() < balanced) return x;
  const Rows N = A * omega.asDiagonal() * A.transpose();
  Rows shifted = N;
  const double shift = 1e-10 * N.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < N.rows(); ++k) shifted.coeffRef(k, k) += shift;
  const Eigen::SimplicialLDLT<Rows> factor(shifted);
  Eigen::VectorXd alpha = Eigen::VectorXd::Zero(r.size()), z = factor.solve(r), p = z;
  double rz = r.dot(z);
  constexpr int most = 100;
  for (int k = 0; k < most && r.cwiseAbs().maxCoeff() > balanced; ++k) {
    const Eigen::VectorXd Np = N * p;
    const double step = rz / p.dot(Np);
    alpha += step * p;
    r -= step * Np;
    z = factor.solve(r);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return x + omega.asDiagonal() * (A.transpose() * alpha);
}

/// The bonds of one body, those that a turn maps onto each other as one unknown.
class Sector {
 public:
  Sector(const InitialParticles& initial, Bonds& bonds, int body)
      : initial_(initial), bonds_(bonds), first_(initial.first[body]), last_(initial.first[body + 1]) {
    find_reverse();
    find_classes();
    find_inside();
  }

  void balance_areas();
  void balance_weights();

 private:
  struct Bond {
    Vector X, e;
    double r;
  };
  Bond bond(int b) const {
    const Vector X = vector(bonds_.X[b]);
    return {X, X.normalized(), X.norm()};
  }
  int begin() const { return bonds_.begin[first_]; }
  int end() const { return bonds_.begin[last_]; }
  int find(int i, int j) const {
    const auto from = bonds_.j.begin() + bonds_.begin[i], to = bonds_.j.begin() + bonds_.begin[i + 1];
    return static_cast<int>(std::lower_bound(from, to, j) - bonds_.j.begin());
  }
  void find_reverse();
  void find_classes();
  void find_inside();
  bool at_surface(int i) const;
  /// f(b), b a bond of particle i
  template <class F>
  void for_each_bond(int i, const F& f) const {
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) f(b);
  }
  Eigen::Matrix2d area_of_unit(int i) const {  // V_i B_i
    Eigen::Matrix2d B;
    B << bonds_.B[i][0][0], bonds_.B[i][0][1], bonds_.B[i][1][0], bonds_.B[i][1][1];
    return initial_.V0[i] * B;
  }
  void add_force_rows(int i, int row, std::vector<Eigen::Triplet<double>>& entries) const;

  const InitialParticles& initial_;
  Bonds& bonds_;
  int first_, last_;                  // particles of the body
  std::vector<int> reverse_, class_;  // [bond − begin()]
  int classes_ = 0;
  std::vector<unsigned char> inside_;  // [particle − first_]
  std::vector<int> chosen_;            // one of the particles that a turn maps onto each other
};

void Sector::find_reverse() {
  reverse_.resize(end() - begin());
  for (int i = first_; i < last_; ++i)
    for_each_bond(i, [&](int b) { reverse_[b - begin()] = find(bonds_.j[b], i); });
}

void Sector::find_classes() {
  std::vector<int> owner(end() - begin());
  for (int i = first_; i < last_; ++i) for_each_bond(i, [&](int b) { owner[b - begin()] = i; });
  class_.assign(end() - begin(), -1);
  for (int start = begin(); start < end(); ++start) {
    if (class_[start - begin()] >= 0) continue;
    for (int b = start; class_[b - begin()] < 0;) {
      class_[b - begin()] = classes_;
      b = find(initial_.turned[owner[b - begin()]], initial_.turned[bonds_.j[b]]);
    }
    ++classes_;
  }
  std::vector<unsigned char> seen(last_ - first_);
  for (int start = first_; start < last_; ++start) {
    if (seen[start - first_]) continue;
    chosen_.push_back(start);
    for (int i = start; !seen[i - first_]; i = initial_.turned[i]) seen[i - first_] = 1;
  }
}

/// No bond in a third of all directions
bool Sector::at_surface(int i) const {
  constexpr double widest = 100 * std::numbers::pi / 180;
  std::vector<double> angle;
  for_each_bond(i, [&](int b) { angle.push_back(std::atan2(bonds_.X[b][1], bonds_.X[b][0])); });
  std::ranges::sort(angle);
  if (angle.size() < 3) return true;
  double gap = angle.front() + 2 * std::numbers::pi - angle.back();
  for (std::size_t k = 1; k < angle.size(); ++k) gap = std::max(gap, angle[k] - angle[k - 1]);
  return gap > widest;
}

void Sector::find_inside() {
  std::vector<unsigned char> surface(last_ - first_);
  for (int i = first_; i < last_; ++i) surface[i - first_] = at_surface(i);
  inside_.assign(last_ - first_, 1);
  for (int i = first_; i < last_; ++i) {
    if (surface[i - first_]) inside_[i - first_] = 0;
    for_each_bond(i, [&](int b) {
      if (surface[bonds_.j[b] - first_]) inside_[i - first_] = 0;
    });
  }
}

/// Unknowns ξ, η of each pair: a_ij = (1 + ξ) α X + η α X⊥, seen from either side.
void Sector::balance_areas() {
  const auto pair = [&](int b) {
    return 2 * std::min(class_[b - begin()], class_[reverse_[b - begin()] - begin()]);
  };
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> target;
  const auto add_row = [&](double value) {
    target.push_back(value);
    return static_cast<int>(target.size()) - 1;
  };
  for (const int i : chosen_) {
    const Eigen::Matrix2d mine = area_of_unit(i);
    const double scale = mine.trace() / (2 * initial_.V0[i]);  // of B
    std::array<int, 4> keep{};
    for (int& row : keep) row = add_row(0);
    const bool inside = inside_[i - first_];
    Vector excess = Vector::Zero();
    const double spacing = std::sqrt(initial_.V0[i]);
    const int none = inside ? add_row(0) : -1, too = inside ? add_row(0) : -1;
    for_each_bond(i, [&](int b) {
      const Vector a = vector(bonds_.area[b]), X = bond(b).X, across{-a[1], a[0]};
      for (int k = 0; k < 4; ++k) {
        entries.emplace_back(keep[k], pair(b), scale * a[k / 2] * X[k % 2]);
        entries.emplace_back(keep[k], pair(b) + 1, scale * across[k / 2] * X[k % 2]);
      }
      if (!inside) return;
      const Eigen::Matrix2d both = (mine + area_of_unit(bonds_.j[b])) / spacing;
      const Vector along = both * a, beside = both * across;
      excess += along;
      for (int k = 0; k < 2; ++k) {
        entries.emplace_back(k == 0 ? none : too, pair(b), along[k]);
        entries.emplace_back(k == 0 ? none : too, pair(b) + 1, beside[k]);
      }
    });
    if (inside) target[none] = -excess[0], target[too] = -excess[1];
  }
  Rows A(static_cast<Eigen::Index>(target.size()), 2 * classes_);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(2 * classes_);
  const Eigen::VectorXd change = least_change(A, Eigen::Map<const Eigen::VectorXd>(target.data(), A.rows()),
                                              none, Eigen::VectorXd::Ones(2 * classes_));
  for (int b = begin(); b < end(); ++b) {
    const double along = 1 + change[pair(b)], across = change[pair(b) + 1];
    const Point a = bonds_.area[b];
    bonds_.area[b] = {along * a[0] - across * a[1], along * a[1] + across * a[0], 0};
  }
}

constexpr int strains = 3, force_rows = 2 * strains;

double stretch(int strain, const Vector& e) {  // e·H e of ε_xx, ε_yy, ε_xy
  return strain == 0 ? e[0] * e[0] : strain == 1 ? e[1] * e[1] : e[0] * e[1];
}

/// The force on i of the bonds and of what is cancelled of them, over G and the spacing, from `row` on.
void Sector::add_force_rows(int i, int row, std::vector<Eigen::Triplet<double>>& entries) const {
  const double spacing = std::sqrt(initial_.V0[i]);
  const auto add = [&](int b, const Vector& of_unit_stretch, const Vector& e) {
    for (int s = 0; s < strains; ++s)
      for (int k = 0; k < 2; ++k)
        entries.emplace_back(row + 2 * s + k, class_[b - begin()],
                             stretch(s, e) * of_unit_stretch[k] / spacing);
  };
  Vector of_itself = Vector::Zero();
  for_each_bond(i, [&](int b) { of_itself += vector(bonds_.gradient[b]); });
  for_each_bond(i, [&](int b) {
    const auto [X, e, r] = bond(b);
    const int j = bonds_.j[b], back = reverse_[b - begin()];
    add(b, initial_.V0[i] * (1 / r - e.dot(of_itself)) * e, e);
    add(back, initial_.V0[j] / r * e, e);
    const Vector g = vector(bonds_.gradient[back]);
    for_each_bond(j, [&](int c) {
      const Vector d = bond(c).e;
      add(c, initial_.V0[j] * d.dot(g) * d, d);
    });
  });
}

void Sector::balance_weights() {
  std::vector<Eigen::Triplet<double>> entries;
  int rows = 0;
  for (const int i : chosen_) {
    if (!inside_[i - first_]) continue;
    add_force_rows(i, rows, entries);
    rows += force_rows;
  }
  Rows A(rows, classes_);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd w(classes_);
  for (int b = begin(); b < end(); ++b) w[class_[b - begin()]] = bonds_.weight[b];
  const Eigen::VectorXd omega = w.cwiseMax(0.5);  // a bond without weight may get one
  const Eigen::VectorXd solved = least_change(A, Eigen::VectorXd::Zero(rows), w, omega);
  for (int b = begin(); b < end(); ++b) bonds_.weight[b] = solved[class_[b - begin()]];
}

}  // namespace

void balance_areas(const InitialParticles& initial, Bonds& bonds) {
  for (std::size_t body = 0; body + 1 < initial.first.size(); ++body)
    Sector(initial, bonds, static_cast<int>(body)).balance_areas();
}

void balance_weights(const InitialParticles& initial, Bonds& bonds) {
  for (std::size_t body = 0; body + 1 < initial.first.size(); ++body)
    Sector(initial, bonds, static_cast<int>(body)).balance_weights();
}

}  // namespace taut
