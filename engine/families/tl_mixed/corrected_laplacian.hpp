#pragma once

#include <utility>
#include <vector>

#include "engine/solver/initial_pairs.hpp"

namespace taut::inline TAUT_ISA {

/// L[f]_i = Σ_j w_ij (f_j − f_i) on the pairs of the start, with
///   w_ij = V_j (ΔW + α_i·r_ij + β_i r_ij²),   r_ij = X_i − X_j,            [Lee2016] Eq. A.1, A.2
/// and α, β such that L of a linear field is 0 and that of |X − X_i|² is 2 Dim (A.3–A.5, printed for 3D).
/// ΔW = W″ + (Dim − 1) W′/r. The w_ij are stored times `scale`, m². Where the neighbours cannot tell |X − X_i|²
/// from a linear field, as those at the corner of a cube of particles (all within dp along each axis) cannot,
/// β is 0 and the second condition is left out.
/// Not symmetric: Σ V_i L[f]_i ≠ 0.
template <class K, int Dim>
std::vector<double> corrected_laplacian(const InitialPairs<Dim>& pairs,
                                        const std::vector<Vec<double, Dim>>& X, const std::vector<double>& V,
                                        double h, double scale) {
  constexpr int N = Dim + 1;
  std::vector<double> w(pairs.j.size());
  for (int i = 0; i < pairs.size(); ++i) {
    // lengths in h, so that the rows of the system are of one size; the last column is the right side
    double A[N][N + 1] = {};
    A[Dim][N] = 2 * Dim;
    const auto basis = [&](int p, double(&r)[N]) {
      r[Dim] = 0;
      for (int a = 0; a < Dim; ++a) {
        r[a] = (X[i][a] - X[pairs.j[p]][a]) / h;
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
      if (k == Dim && A[Dim][Dim] < 1e-9 * squares) {
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
  }
  return w;
}
inline constexpr TermInfo corrected_laplacian_info{
    "dissipation", "D(U) = c_p dp (ε₂ L[U] − ε₄ dp² L*[L[U]]), L corrected", "[Lee2016] Eq. 36, 37, A.1–A.5",
    "families/tl_mixed/corrected_laplacian.hpp:corrected_laplacian",
    "corrected Laplacian: 0 of linear fields, 2 d of the square of the distance, at surfaces too"};

/// V_j w_ji/V_i of each pair, so that L*[f]_i = Σ_j (V_j w_ji/V_i f_j − w_ij f_i) is the adjoint of L:
/// Σ V_i g_i L[f]_i = Σ V_i f_i L*[g]_i.
template <int Dim>
std::vector<double> adjoint_weights(const InitialPairs<Dim>& pairs, const std::vector<double>& w,
                                    const std::vector<double>& V) {
  std::vector<double> adjoint(w.size());
  for (int i = 0; i < pairs.size(); ++i) {
    for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
      const int j = pairs.j[p];
      for (int q = pairs.begin[j]; q < pairs.begin[j + 1]; ++q)
        if (pairs.j[q] == i) adjoint[p] = V[j] * w[q] / V[i];
    }
  }
  return adjoint;
}

/// Σ_j (from_j f_j − from_i f_i) of up to four fields at once: L*[U], or L[U] with both weights alike.
template <int Dim>
Pack weighted_sum(const InitialPairs<Dim>& pairs, const std::vector<double>& from_j,
                  const std::vector<double>& from_i, const std::vector<StoredPack>& U, int i) {
  const Pack own = U[i].value;
  Pack sum{};
  for (int p = pairs.begin[i], end = pairs.begin[i + 1]; p < end; ++p)
    sum += from_j[p] * U[pairs.j[p]].value - from_i[p] * own;
  return sum;
}

/// L[U] of up to four fields at once.
template <int Dim>
Pack laplacian_sum(const InitialPairs<Dim>& pairs, const std::vector<double>& w,
                   const std::vector<StoredPack>& U, int i) {
  const Pack own = U[i].value;
  Pack sum{};
  for (int p = pairs.begin[i], end = pairs.begin[i + 1]; p < end; ++p)
    sum += w[p] * (U[pairs.j[p]].value - own);
  return sum;
}

/// The spectral radius of dp⁴ L*[L[·]], from below but for a per cent or two: 100 rounds of power iteration. 40 inside a cubic lattice with 26 neighbours, 75 at the edges of three layers of
/// particles in the middle of cells. The same for any number of threads.
template <int Dim>
double biharmonic_spectral_radius(const InitialPairs<Dim>& pairs, const std::vector<double>& w,
                                  const std::vector<double>& outer, int threads) {
  const int n = pairs.size();
  std::vector<StoredPack> U(n), once(n), twice(n);
  for (int i = 0; i < n; ++i) U[i].value = Pack{std::sin(1.0 + 7.3 * i), std::cos(1.9 * i * i)};
  double greatest = 0;
  for (int round = 0; round < 100; ++round) {
    parallel_for(n, threads, [&](int i) TAUT_FLATTEN { once[i].value = laplacian_sum(pairs, w, U, i); });
    parallel_for(n, threads,
                 [&](int i) TAUT_FLATTEN { twice[i].value = weighted_sum(pairs, outer, w, once, i); });
    Pack before{}, after{};
    for (int i = 0; i < n; ++i) before += U[i].value * U[i].value, after += twice[i].value * twice[i].value;
    greatest = std::sqrt(std::max(after[0] / before[0], after[1] / before[1]));
    const Pack size = root(after) + Pack{0, 0, 1, 1};
    for (int i = 0; i < n; ++i) U[i].value = twice[i].value / size;
  }
  return greatest;
}

}  // namespace taut::inline TAUT_ISA
