#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/motion_bound.hpp"
#include "engine/contact/particles_at_faces.hpp"
#include "engine/contact/point_search.hpp"
#include "engine/core/archive.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

/// Contact candidates within a body: particles at faces that were initially far apart and have come near. The storage
/// order must not change.
template <int Dim>
class OwnPairs {
 public:
  using V = Vec<double, Dim>;

  OwnPairs(const SolverInput& input, double reach) : dp_(input.constants.dp), reach_(reach) {
    if (!input.keeps_neighbors) return;
    ids_ = particles_at_faces(input.scene, input.initial);
    for (const int id : ids_) {
      V x;
      for (int k = 0; k < Dim; ++k) x[k] = input.initial.x[id][k];
      search_.add(x, input.initial.body[id]);
    }
  }

  bool search(const Particles<Dim>& s, std::optional<double> way) {
    if (ids_.empty() || (way && bound_.holds(*way))) return false;
    place(s);
    if (way && bound_.still_holds(x_, search_.bodies(), *way)) return false;
    find(s);
    if (way) bound_.holds(*way);
    return true;
  }

  /// Partners of stored particle i: j[begin[i]] … j[begin[i + 1] − 1]. Both vectors may be empty.
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
  static constexpr double skin = 1;
  static constexpr double horizon = 4;
  static constexpr double far_apart = 4;  // least initial distance

  void place(const Particles<Dim>& s) {
    stored_.resize(ids_.size());
    const std::vector<int> where = s.places_of_ids();
    x_.clear();
    for (std::size_t k = 0; k < ids_.size(); ++k) x_.push_back(s.x[stored_[k] = where[ids_[k]]]);
  }

  void find(const Particles<Dim>& s) {
    found_.clear();
    const double beyond =
        search_.find(x_, reach_ + skin * dp_, horizon * dp_, far_apart * dp_, [&](int a, int b) {
          found_.emplace_back(stored_[a], b);
          found_.emplace_back(stored_[b], a);
        });
    list(s.size());
    bound_.restart(beyond - reach_, x_);
  }

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

  double dp_, reach_;     // m
  std::vector<int> ids_;  // ascending
  PointSearch<Dim> search_;
  std::vector<V> x_;  // m
  std::vector<int> stored_;
  MotionBound<Dim> bound_;
  std::vector<std::pair<int, int>> found_;
};

}  // namespace taut
