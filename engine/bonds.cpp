#include "engine/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "engine/kernels/kernel.hpp"
#include "engine/solver/neighbors.hpp"

namespace taut {
namespace {

constexpr int Dim = 2;  // of the scenes of this version; the code below is for 3 too

/// One product e_a e_b e_c e_d of four components of a unit vector, by the power of each component.
using Powers = std::array<int, Dim>;

std::vector<Powers> fourth_moments() {
  std::vector<Powers> all;
  const auto fill = [&](auto& self, Powers powers, int axis, int left) -> void {
    powers[axis] = left;
    if (axis == Dim - 1) return all.push_back(powers);
    for (; powers[axis] >= 0; --powers[axis]) self(self, powers, axis + 1, left - powers[axis]);
  };
  fill(fill, Powers{}, 0, 4);
  return all;
}

/// δ_ab δ_cd + δ_ac δ_bd + δ_ad δ_bc: 3 for e_x⁴, 1 for e_x² e_y², 0 with an odd power.
double isotropic(const Powers& powers) {
  double value = 1;
  for (int p : powers) value *= p % 2 == 1 ? 0 : (p == 4 ? 3 : 1);
  return value;
}

/// w = ω ∘ (1 + Mᵀ α) with M w = target, the smallest such change of ω. Weights that come out negative are
/// set to 0 and the others solved for again.
Eigen::VectorXd corrected(const Eigen::MatrixXd& M, const Eigen::VectorXd& target, Eigen::VectorXd omega) {
  for (Eigen::Index round = 0; round <= omega.size(); ++round) {
    const Eigen::MatrixXd A = M * omega.asDiagonal() * M.transpose();
    const Eigen::VectorXd alpha = A.completeOrthogonalDecomposition().solve(target - M * omega);
    const Eigen::VectorXd w = omega + omega.asDiagonal() * (M.transpose() * alpha);
    if (w.size() == 0 || w.minCoeff() >= 0) return w;
    omega = (w.array() < 0).select(0.0, omega);
  }
  return omega;
}

/// The bonds of one particle from X_j − X_i and V_j, a column and an entry for each.
class Correction {
 public:
  explicit Correction(double h) : h_(h), powers_(fourth_moments()), target_(powers_.size()) {
    for (std::size_t m = 0; m < powers_.size(); ++m) target_[m] = isotropic(powers_[m]);
  }

  void operator()(const Eigen::MatrixXd& X, const Eigen::VectorXd& V, Bonds& bonds) const {
    using K = Kernel<KernelName::wendland_c2>;
    Eigen::MatrixXd M(powers_.size(), X.cols()), slope(Dim, X.cols());
    Eigen::VectorXd omega(X.cols());
    for (Eigen::Index b = 0; b < X.cols(); ++b) {
      const double r = X.col(b).norm();
      const Eigen::VectorXd e = X.col(b) / r;
      const double minus_dW = -K::alpha(Dim) / std::pow(h_, Dim + 1) * K::dw(r / h_);
      omega[b] = (Dim + 2) * minus_dW * r * V[b];
      slope.col(b) = minus_dW * V[b] * e;
      for (std::size_t m = 0; m < powers_.size(); ++m) {
        M(m, b) = 1;
        for (int k = 0; k < Dim; ++k) M(m, b) *= std::pow(e[k], powers_[m][k]);
      }
    }
    const Eigen::VectorXd w = corrected(M, target_, omega);
    const Eigen::MatrixXd B = (X * slope.transpose()).completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::MatrixXd gradient = B.transpose() * slope;
    for (Eigen::Index b = 0; b < X.cols(); ++b) {
      bonds.r0.push_back(X.col(b).norm());
      bonds.weight.push_back(w[b]);
      Point g{};
      for (int k = 0; k < Dim; ++k) g[k] = gradient(k, b);
      bonds.gradient.push_back(g);
    }
  }

 private:
  double h_;
  std::vector<Powers> powers_;
  Eigen::VectorXd target_;
};

/// The particles of its own body within reach of each one, by id.
std::vector<std::vector<int>> neighbors_at_start(const Layout& layout, double reach) {
  const int n = layout.size();
  std::vector<Vec<double, Dim>> x(n), sorted(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < Dim; ++k) x[i][k] = layout.x[i][k];
  CellGrid<Dim> grid;
  const std::vector<int> order = grid.sort(x, reach);
  for (int i = 0; i < n; ++i) sorted[i] = x[order[i]];
  Neighbors found;
  NeighborSearch<Dim>()(grid, sorted, reach, 1, found);
  std::vector<std::vector<int>> near(n);
  for (int i = 0; i < n; ++i) {
    const int id = order[i];
    for (int k = lanes * found.begin[i]; k < lanes * found.begin[i + 1]; ++k) {
      const int other = order[found.j[k]];
      if (other != id && layout.body[other] == layout.body[id]) near[id].push_back(other);
    }
  }
  return near;
}

}  // namespace

Bonds make_bonds(const Layout& layout, double h, double reach) {
  const Correction correct(h);
  Bonds bonds;
  bonds.begin.push_back(0);
  const std::vector<std::vector<int>> near = neighbors_at_start(layout, reach);
  for (int i = 0; i < layout.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(near[i].size());
    Eigen::MatrixXd X(Dim, count);
    Eigen::VectorXd V(count);
    for (Eigen::Index b = 0; b < count; ++b) {
      for (int k = 0; k < Dim; ++k) X(k, b) = layout.x[near[i][b]][k] - layout.x[i][k];
      V[b] = layout.V0[near[i][b]];
    }
    bonds.j.insert(bonds.j.end(), near[i].begin(), near[i].end());
    correct(X, V, bonds);
    bonds.begin.push_back(static_cast<int>(bonds.j.size()));
  }
  return bonds;
}

}  // namespace taut
