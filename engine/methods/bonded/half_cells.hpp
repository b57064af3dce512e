#pragma once

#include <cmath>
#include <vector>

#include "engine/core/columns.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"
#include "engine/methods/bonded/layout/setup.hpp"
#include "engine/methods/bonded/packed_bonds.hpp"
#include "engine/term_info.hpp"
#include "engine/terms/bond.hpp"

namespace taut {

/// Clamped particles with half cells (THEORY.md, Clamps).
template <int Dim>
class HalfCells {
 public:
  using Direction = Vec<double, Dim>;
  using Square = Mat<double, Dim>;

  /// `ids` is in storage order.
  HalfCells(const BondedSetup& setup, const std::vector<int>& ids);

  /// Sets Q of the half cells, and adds their share to Q of the particles in front.
  template <class Column, class Law>
  void pass(const Column& x, const Law& law, int threads, Columns<Dim * Dim>& Q);
  /// Energy of particle i minus its energy with F_i, J; 0 if it has no half cell.
  template <class Column, class Law>
  double energy_change(int i, const Column& x, const Law& law) const;
  bool contains(int i) const { return !cell_of_.empty() && cell_of_[i] >= 0; }
  /// The deformation gradient that the half cell i uses.
  template <class Column>
  Square deformation_at(int i, const Column& x) const {
    const Cell& cell = cells_[cell_of_[i]];
    return middle_deformation(cell, deformation(cell.own, x), deformation(cell.next, x));
  }

 private:
  struct Gradient {
    int j;
    Direction g;  // 1/m
  };
  struct Row {
    int i;  // stored index
    Square B;
    int begin, end;  // in gradients_
  };
  struct Term {
    Direction e;
    double strength;  // J, see CancelledTerm
  };
  struct Cell {
    Row own, next;
    int material;
    double V;           // m^Dim
    Square half_along;  // ½ (1 − N ⊗ N)
    int begin, end;     // in terms_
  };

  static Direction vector(const Point& p) {
    Direction v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  }
  Row row(const Bonds& bonds, int id, const std::vector<int>& where);
  template <class Column>
  Square deformation(const Row& row, const Column& x) const;
  /// F_i + ½ (F_next − F_i) (1 − N ⊗ N)
  static Square middle_deformation(const Cell& cell, const Square& own, const Square& next) {
    return own + product(next + (-1.0) * own, cell.half_along);
  }
  template <class Law>
  double energy(const Cell& cell, const Square& F, const Law& law) const;
  template <class Law>
  Square stress(const Cell& cell, const Square& F, const Law& law) const;

  std::vector<Cell> cells_;
  std::vector<int> cell_of_;  // [stored] or −1; empty without cells
  std::vector<Gradient> gradients_;
  std::vector<Term> terms_;
  std::vector<Square> T_;  // [cell] J
};

/// Id of the free particle in front of a clamped particle; −1 if it has no half cell, that is, if it also has neighbours
/// behind it, or free ones beside it.
template <int Dim>
int free_in_front(const Bonds& bonds, int i) {
  constexpr double least = 0.3;  // cosine; more than 0 for jittered layouts
  const auto product = [](const Point& a, const Point& b) {
    double sum = 0;
    for (int k = 0; k < Dim; ++k) sum += a[k] * b[k];
    return sum;
  };
  int front = -1;
  Point N{};
  bonds.for_each(i, [&](int j, const ReferenceBond& bond) {
    if (bonds.is_rigid(j) || (front >= 0 && product(bond.X, bond.X) >= product(N, N))) return;
    front = j, N = bond.X;
  });
  bool is_half = front >= 0;
  bonds.for_each(i, [&](int j, const ReferenceBond& bond) {
    const double cosine = product(bond.X, N) / std::sqrt(product(N, N) * product(bond.X, bond.X));
    is_half = is_half && cosine > (bonds.is_rigid(j) ? -least : least);
  });
  return is_half ? front : -1;
}

template <int Dim>
HalfCells<Dim>::HalfCells(const BondedSetup& setup, const std::vector<int>& ids) {
  const Bonds& bonds = setup.bonds;
  const auto is_candidate = [&](int i) { return bonds.is_rigid(i) && bonds.begin[i] < bonds.begin[i + 1]; };
  int first = 0;
  while (first < bonds.size() && !is_candidate(first)) ++first;
  if (first == bonds.size()) return;
  const std::vector<int> where = stored_places(ids);
  std::vector<bool> is_site(bonds.size());
  for (const Interfaces::Site& site : setup.interfaces.sites) is_site[site.id] = true;
  for (int i = first; i < bonds.size(); ++i) {
    const int next = is_candidate(i) ? free_in_front<Dim>(bonds, i) : -1;
    if (next < 0 || is_site[i] || is_site[next]) continue;
    Cell cell{row(bonds, i, where),
              row(bonds, next, where),
              setup.initial.material[i],
              bonds.volume[i],
              {},
              static_cast<int>(terms_.size()),
              0};
    const Direction X = vector(setup.initial.x[next]) - vector(setup.initial.x[i]);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k)
        cell.half_along(a, k) = 0.5 * ((a == k ? 1 : 0) - X[a] * X[k] / dot(X, X));
    for (const CancelledTerm& term : setup.cancelled_terms(i)) {
      const Direction e = vector(term.X);
      terms_.push_back({(1 / std::sqrt(dot(e, e))) * e, term.strength});
    }
    cell.end = static_cast<int>(terms_.size());
    cell_of_.resize(ids.size(), -1);
    cell_of_[cell.own.i] = static_cast<int>(cells_.size());
    cells_.push_back(cell);
  }
  T_.resize(cells_.size());
}

template <int Dim>
auto HalfCells<Dim>::row(const Bonds& bonds, int id, const std::vector<int>& where) -> Row {
  Row row{where[id], {}, static_cast<int>(gradients_.size()), 0};
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < Dim; ++k) row.B(k, a) = bonds.B[id][a][k];
  for (int b = bonds.begin[id]; b < bonds.begin[id + 1]; ++b)
    gradients_.push_back({where[bonds.j[b]], vector(bonds.gradient(id, b))});
  row.end = static_cast<int>(gradients_.size());
  return row;
}

template <int Dim>
template <class Column>
Mat<double, Dim> HalfCells<Dim>::deformation(const Row& row, const Column& x) const {
  Square F{};
  for (int b = row.begin; b < row.end; ++b) add_outer(F, 1.0, x[gradients_[b].j] - x[row.i], gradients_[b].g);
  return F;
}

template <int Dim>
template <class Law>
double HalfCells<Dim>::energy(const Cell& cell, const Square& F, const Law& law) const {
  double E = cell.V * law.energy(cell.material, F);
  for (int k = cell.begin; k < cell.end; ++k) {
    const Direction deformed = F * terms_[k].e;
    E -= terms_[k].strength * cancelled_energy<Dim>(dot(deformed, deformed));
  }
  return E;
}

template <int Dim>
template <class Law>
Mat<double, Dim> HalfCells<Dim>::stress(const Cell& cell, const Square& F, const Law& law) const {
  Square T = cell.V * law.piola(cell.material, F);
  for (int k = cell.begin; k < cell.end; ++k) {
    const Direction deformed = F * terms_[k].e;
    add_outer(T, -terms_[k].strength * cancelled_slope<Dim>(dot(deformed, deformed)), deformed, terms_[k].e);
  }
  return T;
}

template <int Dim>
template <class Column, class Law>
double HalfCells<Dim>::energy_change(int i, const Column& x, const Law& law) const {
  if (!contains(i)) return 0;
  const Cell& cell = cells_[cell_of_[i]];
  const Square own = deformation(cell.own, x), next = deformation(cell.next, x);
  return energy(cell, middle_deformation(cell, own, next), law) - energy(cell, own, law);
}

template <int Dim>
template <class Column, class Law>
void HalfCells<Dim>::pass(const Column& x, const Law& law, int threads, Columns<Dim * Dim>& Q) {
  const int count = static_cast<int>(cells_.size());
  if (count == 0) return;
  parallel_for(count, threads, [&](int n) {
    const Cell& cell = cells_[n];
    const Square own = deformation(cell.own, x), next = deformation(cell.next, x);
    T_[n] = stress(cell, middle_deformation(cell, own, next), law);
  });
  for (int n = 0; n < count; ++n) {  // in order: two cells can have the same next particle
    const auto& [own, next, material, V, half_along, begin, end] = cells_[n];
    const Square T_next = product(T_[n], half_along), Q_own = product(T_[n] + (-1.0) * T_next, own.B),
                 Q_next = product(T_next, next.B);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < Dim; ++k) {
        Q[a * Dim + k][own.i] = Q_own(a, k);
        Q[a * Dim + k][next.i] += Q_next(a, k);
      }
  }
}
inline constexpr TermInfo half_cell_info{
    "clamp", "half cells before a clamp: F = F_i + ½ (F_next − F_i)(1 − N ⊗ N)", "ours",
    "methods/bonded/half_cells.hpp:pass",
    "clamp: columns of particles on their faces swing as with finite elements"};

}  // namespace taut
