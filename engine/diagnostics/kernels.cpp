// Compiled once per instruction set; see engine/CMakeLists.txt.

#include "engine/diagnostics/kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/core/kernels_of.hpp"
#include "engine/core/pack.hpp"
#include "engine/diagnostics/compensated_sum.hpp"
#include "engine/diagnostics/deviator.hpp"

namespace taut {
namespace {

template <int Dim>
struct Fields {
  static constexpr int p = Dim, s = lanes, stored = Dim == 3 ? 6 : 4;
  static constexpr int packs = (s + stored + lanes - 1) / lanes;
  Pack of[packs];

  double operator[](int k) const { return of[k / lanes][k % lanes]; }
};

template <int Dim>
Fields<Dim> fields_of(const SnapshotView& now, int particle) {
  const auto i = static_cast<std::size_t>(particle);
  const double *x = &now.x[i * Dim], *s = &now.s[i * Fields<Dim>::stored];
  if constexpr (Dim == 3)
    return {Pack{x[0], x[1], x[2], now.p[i]}, load(s), Pack{s[4], s[5]}};
  else
    return {Pack{x[0], x[1], now.p[i]}, load(s)};
}

template <int Dim>
Fields<Dim> filtered(const AlternatingView& part, int row, const SnapshotView& now) {
  Fields<Dim> sum{};
  const double* weight = part.weight + part.first_weight[row];
  for (int k = part.begin[row]; k < part.begin[row + 1]; ++k, ++weight) {
    const Pack w = filled<Pack>(*weight);
    const Fields<Dim> q = fields_of<Dim>(now, part.j[k]);
    for (int a = 0; a < Fields<Dim>::packs; ++a) sum.of[a] += w * q.of[a];
  }
  return sum;
}

template <int Dim>
void add_squares(Fields<Dim>& sum, const Fields<Dim>& q) {
  for (int a = 0; a < Fields<Dim>::packs; ++a) sum.of[a] += q.of[a] * q.of[a];
}

template <int Dim>
void put_by_kind(double x, const Fields<Dim>& squares, double* out) {
  using F = Fields<Dim>;
  const auto s = [&](int k) { return squares[F::s + k]; };
  out[0] = x, out[1] = squares[F::p];
  if constexpr (Dim == 3)
    out[2] = 1.5 * (s(0) + s(3) + s(5) + 2 * (s(1) + s(2) + s(4)));
  else
    out[2] = 1.5 * (s(0) + s(2) + s(3) + 2 * s(1));
}

template <int Dim>
void alternating_sums(const AlternatingView& part, const SnapshotView& now, double spacing, double* out,
                      double* squared) {
  Fields<Dim> parts{}, wholes{};
  double x = 0;
  for (int row = 0; row < part.rows; ++row) {
    const Fields<Dim> r = filtered<Dim>(part, row, now);
    double x2 = 0;
    for (int k = 0; k < Dim; ++k) x2 += r[k] * r[k];
    squared[row] = std::min(x2, spacing * spacing);
    x += squared[row];
    add_squares(parts, r);
    add_squares(wholes, fields_of<Dim>(now, part.j[part.begin[row]]));
  }
  put_by_kind(x, parts, out);
  put_by_kind(0, wholes, out + 3);
}

template <int Dim>
void balance(const SnapshotView& now, const StrainDivisors* materials, double contact_energy, double* out) {
  CompensatedSums energies, linear, angular;  // in 2D `linear` includes the angular momentum
  for (std::size_t i = 0; i < now.size; ++i) {
    const double *x = &now.x[i * Dim], *v = &now.v[i * Dim], m = now.m[i];
    double x2 = 0, v2 = 0;
    for (int k = 0; k < Dim; ++k) x2 += x[k] * x[k], v2 += v[k] * v[k];
    double strain = 0;
    if (now.strain_energy) {
      strain = now.strain_energy[i];
    } else {
      const auto [twice_K, four_G] = materials[now.material[i]];
      const double s2 = contracted<Dim>(&now.s[i * Fields<Dim>::stored]);
      strain = m / now.rho[i] * (now.p[i] * now.p[i] / twice_K + s2 / four_G);
    }
    const double speed = std::sqrt(v2);
    energies += Pack{0.5 * m * v2, strain, m * speed, m * std::sqrt(x2) * speed};
    const auto spin = [&](int a, int b) { return m * (x[a] * v[b] - x[b] * v[a]); };
    if constexpr (Dim == 3) {
      linear += Pack{m * v[0], m * v[1], m * v[2]};
      angular += Pack{spin(1, 2), spin(2, 0), spin(0, 1)};
    } else {
      linear += Pack{m * v[0], m * v[1], 0, spin(0, 1)};
    }
  }
  energies += Pack{0, contact_energy};
  const Pack e = energies.value(), p = linear.value(), L = angular.value();
  const double all[]{e[0], e[1], e[2], e[3], p[0], p[1], p[2], L[0], L[1], Dim == 3 ? L[2] : p[3]};
  for (int k = 0; k < 10; ++k) out[k] = all[k];
}

template <int Dim>
constexpr HistoryKernels table{.alternating_sums = alternating_sums<Dim>, .balance = balance<Dim>};

}  // namespace

template <>
const void* kernels_of<int(SharedKernels::history_row)>(int dim, std::string_view) {
  return dim == 3 ? &table<3> : &table<2>;
}

}  // namespace taut
