#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/error.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/neighbors/initial_neighbors.hpp"
#include "engine/neighbors/lane_neighbors.hpp"
#include "engine/term_info.hpp"

namespace taut {

enum class GradientCorrection : std::uint8_t { corrected, normalised };

/// Directed pairs of initial neighbours within a body. k_ij = V_i V_j ∇_i W(X_i − X_j), with k_ji = −k_ij to the last
/// bit. V in k_ij is the whole cell, but V in forces is V0 (see InitialParticles::inside); gradients and forces are
/// then of second order (summation by parts).
template <int Dim>
struct InitialPairs {
  std::vector<int> begin, j;        // begin[i] … begin[i + 1] − 1; j ascends
  std::vector<Vec<double, Dim>> k;  // m^(Dim − 1)
  std::vector<Sym<double, Dim>> B;  // [particle] 1/m^Dim

  int size() const { return static_cast<int>(B.size()); }
};

/// Each pair has `Width` constants, k_ij first; 0 in lanes without neighbour.
template <int Dim, int Width = Dim>
struct PairLanesView {
  struct Group {
    int slots, constants, size;
  };
  struct Constants {
    alignas(sizeof(Pack)) Pack c[Width];
  };

  const Group* groups = nullptr;
  const LaneSlot* slots = nullptr;
  const Constants* constants = nullptr;

  template <class F>
  [[gnu::always_inline]] void for_each(int group, const F& f) const {
    const Group& own = groups[group];
    for (int b = 0; b < own.size; ++b) f(slots[own.slots + b], constants[own.constants + b]);
  }

  /// Σ_j (f_j − f_i) ⊗ k_ij for the fields in the first Dim columns.
  template <int N>
  Mat<Pack, Dim> difference_sum(const ColumnsView<N>& f, int group) const {
    const int first = lanes * group;
    const Vec<Pack, N> own = vector_at<N>(f, first);
    Mat<Pack, Dim> sum{};
    for_each(group, [&](const LaneSlot& slot, const Constants& of_pair) {
      Vec<Pack, N> d;
      gather(f, first, slot, d.c);
      d -= own;
      add_dyad(sum, d, of_pair);
    });
    return sum;
  }
  /// Σ_j (A_i + A_j) k_ij
  Vec<Pack, Dim> pair_sum(const ColumnsView<Dim * Dim>& A, int group) const {
    return pair_sum(A, group, [](const Constants& of_pair) { return of_pair.c; });
  }
  /// Σ_j (A_i + A_j) B_i k_ij, [Lee2016] Eq. 30 with the corrected gradient (Remark 4).
  Vec<Pack, Dim> one_sided_sum(const ColumnsView<Dim * Dim>& A, const Sym<Pack, Dim>& B, int group) const {
    return pair_sum(A, group, [&](const Constants& of_pair) {
      Vec<Pack, Dim> k;
      for (int a = 0; a < Dim; ++a) k[a] = of_pair.c[a];
      return B * k;
    });
  }
  template <class Gradient>
  [[gnu::always_inline]] Vec<Pack, Dim> pair_sum(const ColumnsView<Dim * Dim>& A, int group,
                                                 const Gradient& gradient) const {
    const int first = lanes * group;
    Vec<Pack, Dim> sum{};
    for_each(group, [&](const LaneSlot& slot, const Constants& of_pair) {
      Pack of_j[Dim * Dim];
      gather(A, first, slot, of_j);
      const auto k = gradient(of_pair);
#pragma GCC unroll 3
      for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
        for (int b = 0; b < Dim; ++b) sum[a] += (load(A[a * Dim + b] + first) + of_j[a * Dim + b]) * k[b];
    });
    return sum;
  }
  template <int N>
  static void add_dyad(Mat<Pack, Dim>& sum, const Vec<Pack, N>& d, const Constants& of_pair) {
#pragma GCC unroll 3
    for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
      for (int b = 0; b < Dim; ++b) sum(a, b) += d[a] * of_pair.c[b];
  }
};

template <int Dim, int Width = Dim>
class PairLanes {
 public:
  using View = PairLanesView<Dim, Width>;
  using Constants = typename View::Constants;

  PairLanes() = default;
  /// `constants(p)` returns the array of pair p; must be thread-safe.
  template <class Of>
  PairLanes(const InitialPairs<Dim>& pairs, int threads, const Of& constants);

  View view() const { return {groups_.data(), slots_.from(0), constants_.from(0)}; }

 private:
  std::vector<typename View::Group> groups_;
  SharedRows<LaneSlot> slots_;
  SharedRows<Constants> constants_;
};
inline constexpr TermInfo deformation_info{
    "deformation", "F = I + Σ_j (u_j − u_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start", "[Lee2016] Eq. 34",
    "solver/initial_pairs.hpp:difference_sum",
    "initial pairs: pairs are antisymmetric, within one body, and exact for linear fields"};
inline constexpr TermInfo deformation_rate_info{
    "deformation", "dF/dt = Σ_j (v_j − v_i) ⊗ k_ij B_i, k_ij = V_i V_j ∇W of the start", "[Lee2016] Eq. 33a",
    "solver/initial_pairs.hpp:difference_sum",
    "initial pairs: pairs are antisymmetric, within one body, and exact for linear fields"};
inline constexpr TermInfo internal_force_info{
    "internal force", "f_i = Σ_j (V_i P_i B_i + V_j P_j B_j) k_ij", "[Lee2016] Eq. 29c",
    "solver/initial_pairs.hpp:pair_sum", "initial pairs: the force is minus the derivative of the energy"};

/// Correction B:
/// - corrected: B_i = [Σ_j (X_j − X_i) ⊗ k_ij]⁻¹, exact for linear fields. [Lee2016] Eq. 21, [TranDuc2023] §2.3
/// - normalised: B_i = I/(V_i S), S = 1 + share (Σ_j V_j W_ij − 1), where the sum includes i. [Zhang2020] below
///   Eq. 11, without an equation.
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

/// X_i − X_j to within 2⁻⁴³ h, equal for all particles inside a lattice.
template <int Dim>
Vec<double, Dim> difference_on_grid(const Vec<double, Dim>& X_i, const Vec<double, Dim>& X_j, double h) {
  const double pitch = std::ldexp(1.0, std::ilogb(h) - 42);
  Vec<double, Dim> d = X_i - X_j;
  for (int k = 0; k < Dim; ++k) d[k] = std::nearbyint(d[k] / pitch) * pitch;
  return d;
}

/// Greatest distance of a pair, m. Excludes lattice neighbours at the end of the support.
template <class K>
double reach_of_pairs(double h) {
  return (1 - 1e-9) * K::support * h;
}

/// `V`: volumes of whole cells, m^Dim; `near`: neighbours in the body within reach_of_pairs.
template <class K, int Dim>
InitialPairs<Dim> make_initial_pairs(const NeighborLists& near, const std::vector<Vec<double, Dim>>& X,
                                     const std::vector<double>& V, double h, GradientCorrection gradient,
                                     double share = 1, int threads = 1) {
  InitialPairs<Dim> pairs;
  pairs.begin.assign(near.begin.begin(), near.begin.end());
  pairs.j = near.j;
  pairs.k.resize(pairs.j.size());
  pairs.B.resize(X.size());
  const double scale_W = K::alpha(Dim) / std::pow(h, Dim), scale_dW = scale_W / h;
  parallel_for(static_cast<int>(X.size()), threads, [&](int i) {
    double sum_W = V[i] * scale_W * K::w(0.0);
    Mat<double, Dim> moment{};
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
      const int j = pairs.j[p];
      const Vec<double, Dim> d = difference_on_grid(X[i], X[j], h);
      const double r = std::sqrt(dot(d, d));
      const Vec<double, Dim> k = (V[i] * V[j] * scale_dW * K::dw(r / h) / r) * d;
      sum_W += V[j] * scale_W * K::w(r / h);
      add_outer(moment, 1.0, X[j] - X[i], k);  // exact for linear fields
      pairs.k[p] = k;
    }
    pairs.B[i] = gradient_correction(gradient, moment, V[i], 1 + share * (sum_W - 1));
  });
  return pairs;
}

template <int Dim, int Width>
template <class Of>
PairLanes<Dim, Width>::PairLanes(const InitialPairs<Dim>& pairs, int threads, const Of& constants) {
  const int n = pairs.size(), padded = (n + lanes - 1) / lanes * lanes;
  struct Row {
    std::vector<LaneSlot> slots;
    std::vector<Constants> constants;
  };
  const auto make = [&](int group) {
    const int first = lanes * group;
    std::array<std::vector<int>, lanes> neighbors;
    for (int i = first; i < std::min(first + lanes, n); ++i)
      neighbors[i - first].assign(pairs.j.begin() + pairs.begin[i], pairs.j.begin() + pairs.begin[i + 1]);
    LaneSlots slots = lane_slots(first, neighbors, padded);
    std::vector<Constants> row(slots.slots.size(), Constants{});
    for (std::size_t b = 0; b < row.size(); ++b) {
      for (int lane = 0; lane < lanes; ++lane) {
        if (slots.taken[b][lane] < 0) continue;
        const auto of_pair = constants(pairs.begin[first + lane] + slots.taken[b][lane]);
        for (int c = 0; c < Width; ++c) row[b].c[c][lane] = of_pair[c];
      }
    }
    return Row{std::move(slots.slots), std::move(row)};
  };
  slots_ = SharedRows<LaneSlot>(padded / lanes), constants_ = SharedRows<Constants>(padded / lanes);
  make_in_order(padded / lanes, threads, make, [this](int, const Row& row) {
    groups_.push_back(
        {slots_.add(row.slots), constants_.add(row.constants), static_cast<int>(row.slots.size())});
  });
  slots_.close(), constants_.close();
}

}  // namespace taut
