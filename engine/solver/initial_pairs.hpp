#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/core/tile.hpp"
#include "engine/error.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut::inline TAUT_ISA {

/// The pairs of particles of one body that are initial neighbours, seen from both sides, flat. They
/// never change, and all that depends on them is computed once:
///   k_ij = V_i V_j ∇_i W(X_i − X_j) = −k_ji,
///   ∇f at i = [Σ_j (f_j − f_i) ⊗ k_ij] B_i,     force on i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij.
/// Each of the two gathers one tensor of a neighbour, and the same vector belongs to both. With a symmetric
/// B the force is that of [Lee2016] Eq. 29c and of [TranDuc2023] §2.3, (R_j σ_j N_j + R_i σ_i N_i) ∇W: the
/// derivative of Σ V_i ψ(F_i) by the positions; equal and opposite for each pair to the last bit.
/// In k_ij a particle on a face counts as a whole cell, though its volume in V P B is the part inside the body:
/// then differences are central from the first layer inside on, a uniform stress pushes at the faces alone, and
/// both are of second order (summation by parts; with the parts in k_ij too the reaction of a clamp or a roller
/// would sit in three layers, −5/6, −1/3, +1/6, and stresses converge with order ½).
template <int Dim>
struct InitialPairs {
  std::vector<int> begin, j;        // those of i are begin[i] … begin[i + 1] − 1
  std::vector<Vec<double, Dim>> k;  // m^(Dim − 1)
  std::vector<Sym<double, Dim>> B;  // of each particle, 1/m^Dim

  int size() const { return static_cast<int>(B.size()); }

  /// Σ_j (f_j − f_i) ⊗ k_ij of a vector field whose rows are in_rows(f).
  Tile<Dim> difference_sum(const std::vector<Tile<Dim>>& rows, int i) const {
    const Tile<Dim> own = rows[i];
    Tile<Dim> sum{};
    for (int b = begin[i], end = begin[i + 1]; b < end; ++b) sum += (rows[j[b]] - own) * in_columns(k[b]);
    return sum;
  }
  /// Σ_j (A_i + A_j) k_ij
  Vec<double, Dim> pair_sum(const std::vector<Tile<Dim>>& A, int i) const {
    const Tile<Dim> own = A[i];
    Tile<Dim> sum{};
    for (int b = begin[i], end = begin[i + 1]; b < end; ++b) sum += (A[j[b]] + own) * in_columns(k[b]);
    return sum_of_columns(sum);
  }
};
inline constexpr TermInfo deformation_info{
    "deformation", "F = I + Σ_j (u_j − u_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start", "[Lee2016] Eq. 34",
    "solver/initial_pairs.hpp:difference_sum",
    "pairs of the start: antisymmetric, within a body, gradients of linear fields exact"};
inline constexpr TermInfo deformation_rate_info{
    "deformation", "dF/dt = Σ_j (v_j − v_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start", "[Lee2016] Eq. 33a",
    "solver/initial_pairs.hpp:difference_sum",
    "pairs of the start: antisymmetric, within a body, gradients of linear fields exact"};
inline constexpr TermInfo internal_force_info{
    "internal force", "f_i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij", "[Lee2016] Eq. 29c",
    "solver/initial_pairs.hpp:pair_sum",
    "pairs of the start: the force is minus the derivative of the energy"};

/// The particles of each body in the order of their cells, body after body: what stands at order[i] comes to
/// i.
template <int Dim>
std::vector<int> order_in_space(const std::vector<Vec<double, Dim>>& x, const std::vector<int>& first,
                                double cell) {
  std::vector<int> order;
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    CellGrid<Dim> grid;
    const std::vector<Vec<double, Dim>> body(x.begin() + first[b], x.begin() + first[b + 1]);
    for (const int i : grid.sort(body, cell)) order.push_back(first[b] + i);
  }
  return order;
}

/// How gradients of what particles carry are made right, B above.
/// - corrected: B_i = [Σ_j (X_j − X_i) ⊗ k_ij]⁻¹, exact for linear fields. [Lee2016] Eq. 21, [TranDuc2023]
/// §2.3
/// - normalised: B_i = I/(V_i S), S = 1 + share (Σ_j V_j W_ij − 1) with i itself. [Zhang2020] below Eq. 11
///
/// Differs from [Zhang2020], which says that "the integral" is normalised and prints no equation: here it is
/// the gradient, and the force follows from the energy, so that linear momentum is kept.
template <int Dim>
Sym<double, Dim> gradient_correction(GradientCorrection gradient, const Mat<double, Dim>& moment, double V,
                                     double S) {
  if (gradient == GradientCorrection::corrected) {
    Sym<double, Dim> M;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) M(a, b) = 0.5 * (moment(a, b) + moment(b, a));
    return inverse(M);
  }
  Sym<double, Dim> B{};
  for (int a = 0; a < Dim; ++a) B(a, a) = 1 / (V * S);
  return B;
}

/// The pairs of particles stored in `order_in_space`, of places X and cells V, m^Dim.
template <class K, int Dim>
InitialPairs<Dim> make_initial_pairs(const std::vector<Vec<double, Dim>>& X, const std::vector<double>& V,
                                     const std::vector<int>& first, double h, GradientCorrection gradient,
                                     double share = 1) {
  InitialPairs<Dim> pairs;
  pairs.begin.push_back(0);
  const double scale_W = K::alpha(Dim) / std::pow(h, Dim), scale_dW = scale_W / h;
  // a lattice may have neighbours at the very end of the support, where a kernel need not be 0: they do not
  // count, whatever the rounding of their places says
  const double reach = (1 - 1e-9) * K::support * h;
  for (std::size_t body = 0; body + 1 < first.size(); ++body) {
    const int start = first[body];
    const std::vector<Vec<double, Dim>> x(X.begin() + start, X.begin() + first[body + 1]);
    CellGrid<Dim> grid;
    grid.sort(x, K::support * h);  // the cells that the particles were sorted by
    Neighbors found;
    NeighborSearch<Dim>()(grid, x, reach, 1, found);
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      const double V_i = V[start + i];
      double sum_W = V_i * scale_W * K::w(0.0);
      Mat<double, Dim> moment{};
      for (int p = lanes * found.begin[i]; p < lanes * found.begin[i + 1]; ++p) {
        const int j = found.j[p];
        if (j == i) continue;  // the filling
        const Vec<double, Dim> d = x[i] - x[j];
        const double r = std::sqrt(dot(d, d)), V_j = V[start + j];
        const Vec<double, Dim> k = (V_i * V_j * scale_dW * K::dw(r / h) / r) * d;
        sum_W += V_j * scale_W * K::w(r / h);
        add_outer(moment, -1.0, d, k);
        pairs.j.push_back(start + j);
        pairs.k.push_back(k);
      }
      pairs.begin.push_back(static_cast<int>(pairs.j.size()));
      pairs.B.push_back(gradient_correction(gradient, moment, V_i, 1 + share * (sum_W - 1)));
    }
  }
  return pairs;
}

}  // namespace taut::inline TAUT_ISA
