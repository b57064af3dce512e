#pragma once

#include <utility>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/solver/initial_pairs.hpp"

namespace taut {

/// Weights w_ij of L[f]_i = Σ_j w_ij (f_j − f_i), times `scale` in m², [Lee2016] Eq. A.1–A.5 (THEORY.md). Departure:
/// no quadratic correction (β = 0) where neighbours hardly distinguish linear from quadratic fields, because large
/// w_ij require tiny time steps.
template <class K, int Dim>
std::vector<double> corrected_laplacian(const InitialPairs<Dim>& pairs,
                                        const std::vector<Vec<double, Dim>>& X, const std::vector<double>& V,
                                        double h, double scale, int threads = 1) {
  constexpr int N = Dim + 1;
  // minimum nonlinear share of Σ V r⁴
  constexpr double least_nonlinear_share = 0.02;
  std::vector<double> w(pairs.j.size());
  parallel_for(pairs.size(), threads, [&](int i) {
    // lengths in h; the last column is the right-hand side
    double A[N][N + 1] = {};
    A[Dim][N] = 2 * Dim;
    const auto basis = [&](int p, double(&r)[N]) {
      const Vec<double, Dim> d = difference_on_grid(X[i], X[pairs.j[p]], h);
      r[Dim] = 0;
      for (int a = 0; a < Dim; ++a) {
        r[a] = d[a] / h;
        r[Dim] += r[a] * r[a];
      }
    };
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
      double r[N];
      basis(p, r);
      const double q = std::sqrt(r[Dim]);
      const double laplacian =
          K::alpha(Dim) / std::pow(h, Dim) * (K::ddw(q) + (Dim - 1) * K::dw(q) / q);  // times h²
      w[p] = V[pairs.j[p]] * laplacian;
      for (int a = 0; a < N; ++a) {
        A[a][N] -= r[a] * w[p];
        for (int b = 0; b < N; ++b) A[a][b] += V[pairs.j[p]] * r[a] * r[b];
      }
    }
    const double squares = A[Dim][Dim];
    for (int k = 0; k < N; ++k) {  // A is positive definite: no pivots
      if (k == Dim && A[Dim][Dim] < least_nonlinear_share * squares) {
        A[Dim][Dim] = 1, A[Dim][N] = 0;
        break;
      }
      for (int row = 0; row < N; ++row) {
        if (row == k) continue;
        const double factor = A[row][k] / A[k][k];
        for (int col = k; col <= N; ++col) A[row][col] -= factor * A[k][col];
      }
    }
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
      double r[N];
      basis(p, r);
      for (int k = 0; k < N; ++k) w[p] += V[pairs.j[p]] * r[k] * A[k][N] / A[k][k];
      w[p] *= scale / (h * h);
    }
  });
  return w;
}
inline constexpr TermInfo corrected_laplacian_info{
    "dissipation", "D(U) = c_p dp (ε₂ L[U] − ε₄ dp² L*[L[U]]), L corrected", "[Lee2016] Eq. 36, 37, A.1–A.5",
    "methods/tl_mixed/corrected_laplacian.hpp:corrected_laplacian",
    "corrected Laplacian: in 2D linear fields give 0, and the squared distance 4, at surfaces too"};

/// V_j w_ji/V_i of the adjoint L* (THEORY.md).
template <int Dim>
std::vector<double> adjoint_weights(const InitialPairs<Dim>& pairs, const std::vector<double>& w,
                                    const std::vector<double>& V, int threads) {
  std::vector<double> adjoint(w.size());
  parallel_for(pairs.size(), threads, [&](int i) {
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
      const int j = pairs.j[p];
      for (int q = pairs.begin[j]; q < pairs.begin[j + 1]; ++q)
        if (pairs.j[q] == i) adjoint[p] = V[j] * w[q] / V[i];
    }
  });
  return adjoint;
}

/// Lanes of k_ij, w_ij and the adjoint weight (w_ij for `adjoint` = 0).
template <int Dim>
using LaplacianLanes = PairLanes<Dim, Dim + 2>;
template <int Dim>
using LaplacianView = PairLanesView<Dim, Dim + 2>;
template <int Dim>
LaplacianLanes<Dim> with_laplacian(const InitialPairs<Dim>& pairs, const std::vector<double>& w,
                                   const std::vector<double>& V, double adjoint, int threads = 1) {
  const std::vector<double> outer = adjoint_weights(pairs, w, V, threads);
  return {pairs, threads, [&](int p) {
            Vec<double, Dim + 2> constants;
            for (int k = 0; k < Dim; ++k) constants[k] = pairs.k[p][k];
            constants[Dim] = w[p];
            constants[Dim + 1] = adjoint * outer[p] + (1 - adjoint) * w[p];
            return constants;
          }};
}

/// Σ_j (f_j − f_i) ⊗ k_ij of the first Dim fields, and L of all.
template <int Dim, int N>
struct DifferencesAndLaplacian {
  Mat<Pack, Dim> differences;
  Vec<Pack, N> laplacian;
};
template <int Dim, int N>
DifferencesAndLaplacian<Dim, N> differences_and_laplacian(const LaplacianView<Dim>& pairs,
                                                          const ColumnsView<N>& U, int group) {
  const int first = lanes * group;
  const Vec<Pack, N> own = vector_at<N>(U, first);
  DifferencesAndLaplacian<Dim, N> sum{};
  pairs.for_each(group, [&](const LaneSlot& slot, const auto& of_pair) {
    Vec<Pack, N> d;
    gather(U, first, slot, d.c);
    d -= own;
    if constexpr (Dim <= N) pairs.add_dyad(sum.differences, d, of_pair);
    sum.laplacian += of_pair.c[Dim] * d;
  });
  return sum;
}

/// L*[U]; L[U] if `pairs` were made with `adjoint` = 0.
template <int Dim, int N>
Vec<Pack, N> second_laplacian(const LaplacianView<Dim>& pairs, const ColumnsView<N>& U, int group) {
  const int first = lanes * group;
  const Vec<Pack, N> own = vector_at<N>(U, first);
  Vec<Pack, N> sum{};
  pairs.for_each(group, [&](const LaneSlot& slot, const auto& of_pair) {
    Vec<Pack, N> of_j;
    gather(U, first, slot, of_j.c);
    sum += of_pair.c[Dim + 1] * of_j - of_pair.c[Dim] * own;
  });
  return sum;
}

/// Times dp⁴, 1 to 2 % low, by power iteration.
template <int Dim>
double biharmonic_spectral_radius(const LaplacianView<Dim>& pairs, int particles, int threads) {
  constexpr int fields = 2;
  Columns<fields> U, once, twice;
  for (Columns<fields>* columns : {&U, &once, &twice}) columns->resize(particles);
  for (int i = 0; i < particles; ++i) U[0][i] = std::sin(1.0 + 7.3 * i), U[1][i] = std::cos(1.9 * i * i);
  double greatest = 0;
  for (int round = 0; round < 100; ++round) {
    parallel_pass(U.size() / lanes, threads, [&](int group) {
      put(differences_and_laplacian(pairs, U, group).laplacian, once, lanes * group);
    });
    parallel_pass(U.size() / lanes, threads,
                  [&](int group) { put(second_laplacian(pairs, once, group), twice, lanes * group); });
    greatest = 0;
    for (int field = 0; field < fields; ++field) {
      double before = 0, after = 0;
      for (int i = 0; i < particles; ++i)
        before += U[field][i] * U[field][i], after += twice[field][i] * twice[field][i];
      greatest = std::max(greatest, std::sqrt(after / before));
      for (int i = 0; i < particles; ++i) U[field][i] = twice[field][i] / std::sqrt(after);
    }
  }
  return greatest;
}

}  // namespace taut
