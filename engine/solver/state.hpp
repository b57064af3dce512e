#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/tensor.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/constants.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/held_pairs.hpp"
#include "engine/solver/particles.hpp"

namespace taut::inline TAUT_ISA {

/// A particle's row of `Width` doubles, filled up to whole packs, as the passes gather it. Rows that fill
/// whole lines of the cache begin with one.
constexpr int row_width(int columns) { return (columns + lanes - 1) / lanes * lanes; }
constexpr std::size_t row_alignment(int columns) { return row_width(columns) % (2 * lanes) == 0 ? 64 : 32; }
template <int Width>
struct alignas(row_alignment(Width)) Row {
  static constexpr int width = row_width(Width);
  double c[width] = {};
};

/// What every pass gathers about a neighbour: velocity (or any other vector), pressure, volume.
template <int Dim>
struct FlowRow : Row<Dim + 2> {
  void set(const Vec<double, Dim>& v, double p, double V) {
    for (int k = 0; k < Dim; ++k) this->c[k] = v[k];
    this->c[Dim] = p;
    this->c[Dim + 1] = V;
  }
};
template <int Dim, class T>
struct Flow {
  Vec<T, Dim> v;  // m/s
  T p;            // Pa
  T V;            // m^Dim
};

/// A symmetric tensor and a scalar of a particle, as the passes gather them.
template <int Dim>
struct TensorRow : Row<Sym<double, Dim>::size + 1> {
  void set(const Sym<double, Dim>& s, double a = 0) {
    for (int k = 0; k < Sym<double, Dim>::size; ++k) this->c[k] = s.c[k];
    this->c[Sym<double, Dim>::size] = a;
  }
  Sym<double, Dim> get() const {
    Sym<double, Dim> s;
    for (int k = 0; k < Sym<double, Dim>::size; ++k) s.c[k] = this->c[k];
    return s;
  }
  double scalar() const { return this->c[Sym<double, Dim>::size]; }
};

template <int Dim>
Flow<Dim, Pack> gather_flow(const std::vector<FlowRow<Dim>>& rows, const int* j) {
  Pack column[Dim + 2];
  gather<Dim + 2, FlowRow<Dim>::width>(rows[0].c, j, column);
  Flow<Dim, Pack> f;
  for (int k = 0; k < Dim; ++k) f.v[k] = column[k];
  f.p = column[Dim];
  f.V = column[Dim + 1];
  return f;
}
template <int Dim>
Flow<Dim, Pack> spread_flow(const FlowRow<Dim>& row) {
  Flow<Dim, Pack> f;
  for (int k = 0; k < Dim; ++k) f.v[k] = filled<Pack>(row.c[k]);
  f.p = filled<Pack>(row.c[Dim]);
  f.V = filled<Pack>(row.c[Dim + 1]);
  return f;
}

template <int Dim>
struct Tensor {
  Sym<Pack, Dim> s;
  Pack a;
};
template <int Dim>
Tensor<Dim> gather_tensor(const std::vector<TensorRow<Dim>>& rows, const int* j) {
  Pack column[TensorRow<Dim>::width];
  gather<TensorRow<Dim>::width>(rows[0].c, j, column);
  Tensor<Dim> t;
  for (int k = 0; k < Sym<Pack, Dim>::size; ++k) t.s.c[k] = column[k];
  t.a = column[Sym<Pack, Dim>::size];
  return t;
}
template <int Dim>
Tensor<Dim> spread_tensor(const TensorRow<Dim>& row) {
  Tensor<Dim> t;
  for (int k = 0; k < Sym<Pack, Dim>::size; ++k) t.s.c[k] = filled<Pack>(row.c[k]);
  t.a = filled<Pack>(row.c[Sym<Pack, Dim>::size]);
  return t;
}

/// The particles and what a method integrates for each. Arrays that a method does not use stay empty.
template <int Dim>
struct State : Particles<Dim> {
  using typename Particles<Dim>::V;
  using Particles<Dim>::x, Particles<Dim>::v, Particles<Dim>::m, Particles<Dim>::mobile, Particles<Dim>::id,
      Particles<Dim>::body, Particles<Dim>::material, Particles<Dim>::size;
  using S = Sym<double, Dim>;

  std::vector<double> rho, drho;     // kg/m³ and its rate
  std::vector<V> a_shear, da_shear;  // accumulated shear acceleration, m/s², and its rate
  std::vector<S> s, ds;              // deviatoric stress, Pa, and its rate
  std::vector<V> x_recovered;        // where x stood when a recovered stress was last brought up to date, m
  bool sph_contact = false;          // of several bodies, whose particles act on each other as those of one

  // gathered by the passes
  std::vector<FlowRow<Dim>> flow;      // at the middle of the step: v, p, V
  std::vector<FlowRow<Dim>> flow_new;  // with the new velocity, or any other vector to take the gradient of
  std::vector<TensorRow<Dim>> stress;  // s
  std::vector<TensorRow<Dim>> repulsion;  // artificial stress R and mass
  // of methods whose stress is only shown, at the last rebuild: correction of the kernel gradient, and volume
  std::vector<TensorRow<Dim>> recovery;

  // of the last rebuild
  Neighbors neighbors;
  std::vector<int> meets;                     // 1: not all neighbours of i are of its own body
  std::vector<std::pair<int, int>> contacts;  // (i, pack) of pairs between bodies, if they act as in one

  HeldPairs<Dim> pairs;

  /// What lasts from one step to the next; what the passes gather is made anew.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed(x, v, m, mobile, rho, drho, a_shear, da_shear, s, ds, x_recovered, id, body, material);
    neighbors.serialize(archive, size());
    archive.fixed(meets, recovery);
    const int packs = meets.empty() ? 0 : neighbors.begin.back();  // whose geometry is held
    archive.indices(contacts, std::pair(size(), packs));
    pairs.serialize(archive);
    archive.check("the geometry of pairs", [&] { return pairs.are_of(packs, !repulsion.empty()); });
  }

  /// Stores the particles in another order: what stood at order[i] comes to i.
  void reorder(const std::vector<int>& order, int threads) {
    taut::reorder(order, threads, x, v, m, mobile, rho, drho, a_shear, da_shear, s, ds, x_recovered, id, body,
                  material);
  }
};

}  // namespace taut::inline TAUT_ISA
