#pragma once

#include <algorithm>
#include <vector>

#include "engine/contact/near_other_bodies.hpp"
#include "engine/core/archive.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/particles.hpp"

namespace taut {

/// Contact candidates of each particle in other bodies.
template <int Dim>
class BodyPairs {
 public:
  BodyPairs(double reach, double skin) : reach_(reach + skin), skin_(skin) {}

  /// Path of the fastest particle until the next search, m.
  double lasts_for() const { return 0.5 * skin_; }

  void search(const Particles<Dim>& s) {
    choose_candidates(s);
    begin.assign(s.size() + 1, 0);
    j.clear();
    if (candidates_.empty()) return;
    const std::vector<int>& order = grid_.sort(x_, reach_);
    stored_.resize(x_.size());
    for (std::size_t k = 0; k < order.size(); ++k) stored_[k] = candidates_[order[k]];
    int next = 0;
    for (const int i : candidates_) {
      while (next <= i) begin[next++] = static_cast<int>(j.size());
      const auto from = static_cast<std::ptrdiff_t>(j.size());
      grid_.for_each_row(s.x[i], [&](int first, int last) {
        for (int k = first; k < last; ++k) {
          const int other = stored_[k];
          if (s.body[other] == s.body[i]) continue;
          const Vec<double, Dim> d = s.x[i] - s.x[other];
          if (dot(d, d) < reach_ * reach_) j.push_back(other);
        }
      });
      // by id, for the same order of additions in mirrored bodies
      std::sort(j.begin() + from, j.end(), [&](int a, int b) { return s.id[a] < s.id[b]; });
    }
    while (next <= s.size()) begin[next++] = static_cast<int>(j.size());
  }

  template <class Archive>
  void serialize(Archive& archive, int particles) {
    archive.fixed(begin);
    archive.indices(j, particles);
    archive.check("the pairs of two bodies", [&] {
      return begin.empty() ? j.empty() : are_rows(begin, static_cast<std::size_t>(particles), j.size());
    });
  }

  std::vector<int> begin, j;

 private:
  void choose_candidates(const Particles<Dim>& s) {
    const std::vector<char> near = near_other_bodies<Dim>(s.x, s.body, reach_);
    candidates_.clear();
    x_.clear();
    for (int i = 0; i < s.size(); ++i) {
      if (!near[i]) continue;
      candidates_.push_back(i);
      x_.push_back(s.x[i]);
    }
  }

  double reach_, skin_;  // m
  CellGrid<Dim> grid_;
  std::vector<int> candidates_;  // ascending
  std::vector<int> stored_;
  std::vector<Vec<double, Dim>> x_;
};

}  // namespace taut
