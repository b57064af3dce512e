#include "engine/methods/bonded/layout/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "engine/core/parallel.hpp"
#include "engine/methods/bonded/layout/bond_gradients.hpp"
#include "engine/methods/bonded/layout/off_lattice.hpp"

namespace taut {
namespace {

using Vector = Eigen::Vector2d;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Tolerance of the relative residual force at strain 1.
constexpr double balanced = 1e-12;
constexpr double infinite = std::numeric_limits<double>::infinity();

Vector vector(const Point& p) { return {p[0], p[1]}; }

/// Multiplies by N = A Ω Aᵀ without storing N.
class NormalMatrix {
 public:
  NormalMatrix(const Rows& A, const Eigen::VectorXd& omega, int threads)
      : A_(A), back_(A.transpose()), omega_(omega), threads_(threads), between_(A.cols()) {}

  Eigen::Index rows() const { return A_.rows(); }
  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd all(rows());
    parallel_for(static_cast<int>(rows()), threads_, [&](int k) {
      double sum = 0;
      for (Rows::InnerIterator a(A_, k); a; ++a) sum += a.value() * a.value() * omega_[a.col()];
      all[k] = sum;
    });
    return all;
  }
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) {
    parallel_for(static_cast<int>(back_.rows()), threads_,
                 [&](int k) { between_[k] = omega_[k] * row_times(back_, k, v); });
    parallel_for(static_cast<int>(rows()), threads_, [&](int k) { out[k] = row_times(A_, k, between_); });
  }

 private:
  static double row_times(const Rows& of, int k, const Eigen::VectorXd& v) {
    double sum = 0;
    for (Rows::InnerIterator a(of, k); a; ++a) sum += a.value() * v[a.col()];
    return sum;
  }

  const Rows& A_;
  Rows back_;
  const Eigen::VectorXd& omega_;
  int threads_;
  Eigen::VectorXd between_;
};

/// Solves A Ω Aᵀ α = r by preconditioned conjugate gradients. Round-off may make rows contradictory: if r grows to
/// 1000 times its least value, returns the α of the least r.
Eigen::VectorXd solve_normal(const Rows& A, const Eigen::VectorXd& omega, Eigen::VectorXd r, int threads) {
  constexpr Eigen::Index largest_factor = 12000;
  NormalMatrix N(A, omega, threads);
  const Eigen::VectorXd diagonal = N.diagonal();
  const double greatest = diagonal.maxCoeff();
  const bool factored = N.rows() <= largest_factor;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  if (factored) {
    Eigen::SparseMatrix<double> shifted = A * omega.asDiagonal() * A.transpose();
    for (Eigen::Index k = 0; k < N.rows(); ++k) shifted.coeffRef(k, k) += 1e-10 * greatest;
    factor.compute(shifted);
  }
  const Eigen::VectorXd scale = diagonal.cwiseMax(1e-10 * greatest).cwiseInverse();
  const auto precondition = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return factored ? Eigen::VectorXd(factor.solve(v)) : Eigen::VectorXd(scale.cwiseProduct(v));
  };
  Eigen::VectorXd alpha = Eigen::VectorXd::Zero(r.size()), z = precondition(r), p = z, Np(r.size());
  double rz = r.dot(z), least = r.cwiseAbs().maxCoeff();
  Eigen::VectorXd best = alpha;
  const int most = factored ? 300 : 100;
  for (int k = 0; k < most && r.cwiseAbs().maxCoeff() > balanced; ++k) {
    N.multiply(p, Np);
    const double step = rz / p.dot(Np);
    alpha += step * p;
    r -= step * Np;
    constexpr double divergence_factor = 1e3;
    const double left = r.allFinite() ? r.cwiseAbs().maxCoeff() : infinite;
    if (!(left < divergence_factor * least)) return best;
    if (left < least) least = left, best = alpha;
    z = precondition(r);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return alpha;
}

constexpr int far = 12;  // bonds
constexpr int strains = 3;
double stretch(int strain, const Vector& e) {  // e·H e for unit ε_xx, ε_yy, γ_xy
  return strain == 0 ? e[0] * e[0] : strain == 1 ? e[1] * e[1] : e[0] * e[1];
}

using Entries = std::vector<Eigen::Triplet<double>>;

/// One body; bonds related by a rotation share unknowns.
class Sector {
 public:
  Sector(const InitialParticles& initial, const Constraints& constraints, Bonds& bonds, int body,
         bool irregular, int threads)
      : initial_(initial),
        constraints_(constraints),
        bonds_(bonds),
        irregular_(irregular),
        threads_(threads),
        first_(initial.first[body]),
        last_(initial.first[body + 1]) {
    find_reverse();
    find_classes();
    find_inside();
  }

  /// Changes a_ij to (1 + ξ) a_ij + η a_ij⊥; ⊥ turns by 90°. Both directions of a bond have the same ξ and η.
  void balance_areas() {
    find_faces();
    std::vector<int> owner(2 * classes_, first_);
    for (int i = first_; i < last_; ++i)
      for_each_bond(i, [&](int b) { owner[pair(b)] = owner[pair(b) + 1] = i; });
    Eigen::VectorXd change = Eigen::VectorXd::Zero(2 * classes_);
    least_change(change, Eigen::VectorXd::Ones(2 * classes_), owner,
                 [&](int i, int row, Entries& entries, std::vector<double>& target) {
                   add_area_rows(i, row, entries, target);
                 });
    // limits of the relative change
    constexpr double greatest = 6, greatest_irregular = 2.25;
    const double most = change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0;
    if (!irregular_ && most > greatest) return;
    if (irregular_ && most > greatest_irregular) change *= std::pow(greatest_irregular / most, 2);
    parallel_for(end() - begin(), threads_, [&](int k) {
      const int b = begin() + k;
      const double along = 1 + change[pair(b)], across = change[pair(b) + 1];
      const Point a = bonds_.rows[b].area;
      bonds_.rows[b].area = {along * a[0] - across * a[1], along * a[1] + across * a[0], 0};
    });
  }
  void balance_weights() {
    std::vector<int> owner(classes_);
    Eigen::VectorXd w(classes_);
    for (int i = first_; i < last_; ++i)
      for_each_bond(i, [&](int b) {
        owner[class_[b - begin()]] = i;
        w[class_[b - begin()]] = bonds_.rows[b].weight;
      });
    const Eigen::VectorXd omega = w.cwiseMax(0.5);  // lets bonds of weight 0 change
    least_change(w, omega, owner, [&](int i, int row, Entries& entries, std::vector<double>& target) {
      add_force_rows(i, row, entries, target);
    });
    parallel_for(end() - begin(), threads_, [&](int k) { bonds_.rows[begin() + k].weight = w[class_[k]]; });
  }

 private:
  struct BondVector {
    Vector X, e;
    double r;
  };
  BondVector bond(int b) const {
    const Vector X = vector(bonds_.rows[b].X);
    return {X, X.normalized(), X.norm()};
  }
  int begin() const { return bonds_.begin[first_]; }
  int end() const { return bonds_.begin[last_]; }
  int find(int i, int j) const {
    const auto from = bonds_.j.begin() + bonds_.begin[i], to = bonds_.j.begin() + bonds_.begin[i + 1];
    const auto found = std::lower_bound(from, to, j);
    return found != to && *found == j ? static_cast<int>(found - bonds_.j.begin()) : -1;
  }
  void find_reverse() {
    reverse_.resize(end() - begin());
    parallel_for(last_ - first_, threads_, [&](int k) {
      for_each_bond(first_ + k, [&](int b) { reverse_[b - begin()] = find(bonds_.j[b], first_ + k); });
    });
  }
  void find_classes() {
    std::vector<int> image(end() - begin());
    turned_ = initial_.turned;
    parallel_for(last_ - first_, threads_, [&](int k) {
      const int i = first_ + k;
      for_each_bond(i, [&](int b) { image[b - begin()] = find(turned_[i], turned_[bonds_.j[b]]); });
    });
    if (std::ranges::count(image, -1) > 0) {  // round-off removed a bond
      std::iota(turned_.begin(), turned_.end(), 0);
      std::iota(image.begin(), image.end(), begin());
    }
    class_.assign(end() - begin(), -1);
    for (int start = begin(); start < end(); ++start) {
      if (class_[start - begin()] >= 0) continue;
      for (int b = start; class_[b - begin()] < 0; b = image[b - begin()]) class_[b - begin()] = classes_;
      ++classes_;
    }
    std::vector<unsigned char> seen(last_ - first_);
    for (int start = first_; start < last_; ++start) {
      if (seen[start - first_]) continue;
      chosen_.push_back(start);
      for (int i = start; !seen[i - first_]; i = turned_[i]) seen[i - first_] = 1;
    }
  }
  void find_inside() {
    at_surface_.resize(last_ - first_);
    parallel_for(last_ - first_, threads_, [&](int k) {
      std::vector<Vector> X;
      X.reserve(bonds_.begin[first_ + k + 1] - bonds_.begin[first_ + k]);
      for_each_bond(first_ + k, [&](int b) { X.push_back(vector(bonds_.rows[b].X)); });
      at_surface_[k] = is_rigid(constraints_[first_ + k]) || is_at_surface(X);
    });
    inside_.resize(last_ - first_);
    parallel_for(last_ - first_, threads_, [&](int k) {
      bool inside = !at_surface_[k];
      for_each_bond(first_ + k, [&](int b) { inside = inside && !at_surface_[bonds_.j[b] - first_]; });
      inside_[k] = inside;
    });
  }
  void find_faces() {
    const int n = last_ - first_;
    along_face_.assign(n, Vector::Zero());
    if (!irregular_) return;
    struct Face {
      Vector sum = Vector::Zero();
      double lengths = 0;
    };
    std::vector<Face> face(n), wider;
    for (int i = first_; i < last_; ++i)
      for_each_bond(i, [&](int b) {
        const Vector g = initial_.V0[i] * vector(bonds_.gradient(i, b));
        face[bonds_.j[b] - first_].sum += g, face[i - first_].sum -= g;
      });
    for (int k = 0; k < n; ++k) {
      if (!at_surface_[k] || is_rigid(constraints_[first_ + k])) face[k].sum.setZero();
      face[k].lengths = face[k].sum.norm();
    }
    constexpr int away = 3;
    for (int round = 0; round < away; ++round, face.swap(wider)) {
      wider = face;
      for (int i = first_; i < last_; ++i)
        for_each_bond(i, [&](int b) {
          const Face& other = face[bonds_.j[b] - first_];
          wider[i - first_].sum += other.sum, wider[i - first_].lengths += other.lengths;
        });
    }
    constexpr double flat = 0.93;
    for (int k = 0; k < n; ++k) {
      const Vector& N = face[k].sum;
      if (inside_[k] || at_surface_[k] || !(N.norm() > flat * face[k].lengths)) continue;
      along_face_[k] = Vector(-N[1], N[0]).normalized();
    }
  }
  template <class F>
  void for_each_bond(int i, const F& f) const {
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) f(b);
  }
  Eigen::Matrix2d area_of_unit(int i) const {
    Eigen::Matrix2d B;
    B << bonds_.B[i][0][0], bonds_.B[i][0][1], bonds_.B[i][1][0], bonds_.B[i][1][1];
    return initial_.V0[i] * B;
  }
  /// Conditions on a_ij (THEORY.md, Balance).
  void add_area_rows(int i, int row, Entries& entries, std::vector<double>& target) const {
    const Eigen::Matrix2d mine = area_of_unit(i);
    const double scale = mine.trace() / (2 * initial_.V0[i]);
    const double spacing = std::sqrt(initial_.V0[i]);
    const bool inside = inside_[i - first_];
    const Vector& along_face = along_face_[i - first_];
    const bool near_face = !along_face.isZero();
    Vector left_over = Vector::Zero();
    for_each_bond(i, [&](int b) {
      const Vector a = vector(bonds_.rows[b].area), X = bond(b).X, across{-a[1], a[0]};
      const auto add = [&](int k, double of_along, double of_across) {
        entries.emplace_back(row + k, pair(b), of_along);
        entries.emplace_back(row + k, pair(b) + 1, of_across);
      };
      for (int k = 0; k < 4; ++k) add(k, scale * a[k / 2] * X[k % 2], scale * across[k / 2] * X[k % 2]);
      if (!inside && !near_face) return;
      const Eigen::Matrix2d both = (mine + area_of_unit(bonds_.j[b])) / spacing;
      const Vector along = both * a, beside = both * across;
      left_over += along;
      if (near_face) return add(4, along_face.dot(along), along_face.dot(beside));
      for (int k = 0; k < 2; ++k) add(4 + k, along[k], beside[k]);
    });
    target.insert(target.end(), 4, 0.0);
    if (inside) target.insert(target.end(), {-left_over[0], -left_over[1]});
    if (near_face) target.push_back(-along_face.dot(left_over));
  }
  /// The force of bonds and cancellation is 0.
  void add_force_rows(int i, int row, Entries& entries, std::vector<double>& target) const {
    if (irregular_ ? at_surface_[i - first_] : !inside_[i - first_]) return;
    const double spacing = std::sqrt(initial_.V0[i]);
    const auto add = [&](int b, const Vector& of_unit_stretch, const Vector& e) {
      for (int s = 0; s < strains; ++s)
        for (int k = 0; k < 2; ++k)
          entries.emplace_back(row + 2 * s + k, class_[b - begin()],
                               stretch(s, e) * of_unit_stretch[k] / spacing);
    };
    Vector of_itself = Vector::Zero();
    for_each_bond(i, [&](int b) { of_itself += vector(bonds_.gradient(i, b)); });
    for_each_bond(i, [&](int b) {
      const auto [X, e, r] = bond(b);
      const int j = bonds_.j[b], back = reverse_[b - begin()];
      add(b, initial_.V0[i] * (1 / r - e.dot(of_itself)) * e, e);
      add(back, initial_.V0[j] / r * e, e);
      const Vector g = vector(bonds_.gradient(j, back));
      for_each_bond(j, [&](int c) {
        const Vector d = bond(c).e;
        add(c, initial_.V0[j] * d.dot(g) * d, d);
      });
    });
    target.insert(target.end(), 2 * strains, 0.0);
  }
  /// Number of bonds to the nearest of `particles`, at most `far`.
  std::vector<int> steps_from(const std::vector<int>& particles) const {
    std::vector<int> steps(last_ - first_, far), edge = particles, next;
    for (const int i : edge) steps[i - first_] = 0;
    for (int step = 1; step < far && !edge.empty(); ++step, edge.swap(next)) {
      next.clear();
      for (const int i : edge)
        for_each_bond(i, [&](int b) {
          int& known = steps[bonds_.j[b] - first_];
          if (known > step) known = step, next.push_back(bonds_.j[b]);
        });
    }
    return steps;
  }
  /// Changes x by the least Σ (Δx)²/ω that satisfies the rows. Leaves x if the residual would not decrease. `owner`:
  /// [unknown] one particle at which a bond with this unknown begins.
  template <class AddRows>
  void least_change(Eigen::VectorXd& x, const Eigen::VectorXd& omega, const std::vector<int>& owner,
                    const AddRows& add_rows) const {
    Entries entries;
    std::vector<double> target, missing;
    const auto residual = [&] {
      missing = target;
      for (const auto& entry : entries) missing[entry.row()] -= entry.value() * x[entry.col()];
      double greatest = 0;
      for (const double m : missing) greatest = std::max(greatest, std::abs(m));
      return greatest;
    };
    std::vector<int> unbalanced;
    for (const int i : chosen_) {
      entries.clear(), target.clear();
      add_rows(i, 0, entries, target);
      if (residual() > balanced) unbalanced.push_back(i);
    }
    if (unbalanced.empty()) return;
    for (std::size_t k = 0, n = unbalanced.size(); k < n; ++k)
      for (int i = turned_[unbalanced[k]]; i != unbalanced[k]; i = turned_[i]) unbalanced.push_back(i);
    const std::vector<int> steps = steps_from(unbalanced);
    entries.clear(), target.clear();
    for (const int i : chosen_)
      if (steps[i - first_] < far) add_rows(i, static_cast<int>(target.size()), entries, target);
    const double before = residual();
    std::erase_if(entries, [&](const auto& entry) { return steps[owner[entry.col()] - first_] >= far - 2; });
    Rows A(static_cast<Eigen::Index>(target.size()), x.size());
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(missing.data(), A.rows());
    const Eigen::VectorXd change = omega.asDiagonal() * (A.transpose() * solve_normal(A, omega, r, threads_));
    if (change.allFinite() && (r - A * change).cwiseAbs().maxCoeff() < before) x += change;
  }
  int pair(int b) const { return 2 * std::min(class_[b - begin()], class_[reverse_[b - begin()] - begin()]); }

  const InitialParticles& initial_;
  const Constraints& constraints_;
  Bonds& bonds_;
  bool irregular_;
  int threads_;
  int first_, last_;
  std::vector<int> turned_;           // InitialParticles::turned or identity
  std::vector<int> reverse_, class_;  // [bond − begin()]
  int classes_ = 0;
  // [particle − first_]
  std::vector<unsigned char> at_surface_, inside_;
  std::vector<Vector> along_face_;  // unit tangent near flat faces, else 0
  std::vector<int> chosen_;         // one particle per orbit of the rotation
};

}  // namespace

void balance(const InitialParticles& initial, const Constraints& constraints,
             const std::vector<bool>& irregular, Bonds& bonds, int threads) {
  std::vector<Sector> sectors;
  for (std::size_t body = 0; body < irregular.size(); ++body)
    sectors.emplace_back(initial, constraints, bonds, static_cast<int>(body), irregular[body], threads);
  for (Sector& one : sectors) one.balance_areas();
  bonds.B = inverse_moments<2>(bonds, initial.size(), threads);
  for (Sector& one : sectors) one.balance_weights();
}

}  // namespace taut
