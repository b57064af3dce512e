#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/archive.hpp"
#include "engine/core/pack.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/motion_bound.hpp"
#include "engine/solver/particles_at_faces.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/solver/state.hpp"

namespace taut::inline TAUT_ISA {

/// Pairs of particles of one body that were far apart at the start and have come near: a body that folds
/// meets itself. Only those that its faces move with (scene/outline.hpp) are looked at. The particles keep
/// their places in the solver's order.
template <int Dim>
class OwnPairs {
 public:
  using V = Vec<double, Dim>;

  /// Pairs nearer than `reach`, m, act.
  OwnPairs(const SolverInput& input, double reach) : dp_(input.constants.dp), reach_(reach) {
    if (!input.meets_itself || input.contact == ContactLaw::surface) return;
    ids_ = particles_at_faces(input.scene, input.initial);
    for (const int id : ids_) {
      body_.push_back(input.initial.body[id]);
      V x;
      for (int k = 0; k < Dim; ++k) x[k] = input.initial.x[id][k];
      X_.push_back(x);
    }
  }

  bool any() const { return !ids_.empty(); }

  /// Searches where the next way of the fastest particle, m, asks for it: true if it did.
  bool prepare(const State<Dim>& s, double way) {
    if (ids_.empty() || bound_.holds(way)) return false;
    place(s);
    if (bound_.still_holds(x_, body_, way)) return false;
    find(s);
    bound_.holds(way);
    return true;
  }
  void search(const State<Dim>& s) {
    if (ids_.empty()) return;
    place(s);
    find(s);
  }

  /// Those of stored particle i are j[begin[i]] … j[begin[i + 1] − 1]; both are empty where there are none.
  std::vector<int> begin, j;

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive(begin);
    archive.indices(j, particles);
    archive.check("the pairs of a body with itself", [&] {
      return begin.empty() ? j.empty() : are_rows(begin, static_cast<std::size_t>(particles), j.size());
    });
    archive(bound_);
  }

 private:
  // in spacings
  static constexpr double skin = 1;       // longer: fewer searches, more pairs
  static constexpr double horizon = 4;    // how far a search looks, for how long it may hold
  static constexpr double far_apart = 4;  // the two faces of a thinner wall do not act on each other

  void place(const State<Dim>& s) {
    stored_.resize(ids_.size());
    std::vector<int> where(s.size());
    for (int i = 0; i < s.size(); ++i) where[s.id[i]] = i;
    x_.clear();
    for (std::size_t k = 0; k < ids_.size(); ++k) x_.push_back(s.x[stored_[k] = where[ids_[k]]]);
  }

  void find(const State<Dim>& s) {
    sort_columns();
    const int n = static_cast<int>(ids_.size());
    double beyond2 = horizon * horizon * dp_ * dp_;
    found_.clear();
    for (int p = 0; p < n; ++p)
      grid_.for_each_row(x_[order_[p]], [&](int first, int last) {
        for (int q = std::max(first, p + 1); q < last; q += lanes) look(p, q, last, beyond2);
      });
    list(s.size());
    bound_.restart(std::sqrt(beyond2) - reach_, x_);
  }

  /// The order of the grid's cells, and in it the columns that a search reads four at a time.
  void sort_columns() {
    order_ = grid_.sort(x_, horizon * dp_);
    const std::size_t n = ids_.size();
    for (int k = 0; k < Dim; ++k) now_[k].resize(n + lanes), start_[k].resize(n + lanes);
    of_body_.resize(n + lanes);
    for (std::size_t p = 0; p < n; ++p) {
      const int a = order_[p];
      for (int k = 0; k < Dim; ++k) now_[k][p] = x_[a][k], start_[k][p] = X_[a][k];
      of_body_[p] = body_[a];
    }
  }

  /// Sorted particle p beside those from q on, which is before `last`: the near ones are kept, and how near
  /// the nearest other one is.
  void look(int p, int q, int last, double& beyond2) {
    const double far = far_apart * dp_, listed = reach_ + skin * dp_;
    Pack d2{}, D2{};
    for (int k = 0; k < Dim; ++k) {
      const Pack d = load(&now_[k][q]) - now_[k][p], D = load(&start_[k][q]) - start_[k][p];
      d2 += d * d, D2 += D * D;
    }
    const unsigned in_row = (1u << std::min(last - q, lanes)) - 1;
    unsigned near =
        in_row & lanes_where((D2 > far * far) & (d2 < beyond2) & (load(&of_body_[q]) == of_body_[p]));
    for (; near != 0; near &= near - 1) {
      const int lane = std::countr_zero(near);
      if (d2[lane] >= listed * listed) {
        beyond2 = std::min(beyond2, d2[lane]);
        continue;
      }
      const int a = order_[p], b = order_[q + lane];
      found_.emplace_back(stored_[a], b);
      found_.emplace_back(stored_[b], a);
    }
  }

  /// What was found, by particle.
  void list(int particles) {
    begin.clear();
    j.clear();
    if (found_.empty()) return;
    std::sort(found_.begin(), found_.end());
    begin.assign(particles + 1, 0);
    for (const auto& [i, b] : found_) {
      ++begin[i + 1];
      j.push_back(stored_[b]);
    }
    for (int i = 0; i < particles; ++i) begin[i + 1] += begin[i];
  }

  double dp_, reach_;      // m
  std::vector<int> ids_;   // in rising order
  std::vector<int> body_;  // of each of them
  std::vector<V> X_, x_;   // at the start and now, m
  std::vector<int> stored_;
  MotionBound<Dim> bound_;
  CellGrid<Dim> grid_;
  // of a search
  std::vector<int> order_;
  std::array<std::vector<double>, Dim> now_, start_;  // m
  std::vector<double> of_body_;
  std::vector<std::pair<int, int>> found_;  // stored i, and j in the order of creation
};

}  // namespace taut::inline TAUT_ISA
