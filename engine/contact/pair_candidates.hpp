#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/contact/body_pairs.hpp"
#include "engine/contact/own_pairs.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/solver/particles.hpp"
#include "engine/solver/solver_input.hpp"

namespace taut {

template <int Dim>
class PairCandidates {
 public:
  /// `reach`: range of pairs of two bodies, m.
  PairCandidates(const SolverInput& input, bool between_bodies, double reach)
      : between_bodies_(between_bodies),
        dp_(input.constants.dp),
        others_(reach, skin * dp_),
        own_(input, dp_) {}

  bool search(const Particles<Dim>& s, const WallContacts<Dim>& walls, std::optional<double> way) {
    travelled_ += way.value_or(0);
    const bool others = !way || ((between_bodies_ || walls.any()) && travelled_ > others_.lasts_for());
    const bool own = own_.search(s, way);
    if (others) search_others(s, walls);
    return others || own;
  }

  std::vector<int> particles(int count) const {
    std::vector<int> found;
    for (int i = 0; i < count; ++i)
      if ((between_bodies_ && others_.begin[i] < others_.begin[i + 1]) ||
          (!own_.begin.empty() && own_.begin[i] < own_.begin[i + 1]))
        found.push_back(i);
    for (const auto& [i, wall] : near_walls_) found.push_back(i);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  template <class F>
  void for_each(int i, const F& f) const {
    const auto visit = [&](const auto& list) {
      for (int k = list.begin[i]; k < list.begin[i + 1]; ++k) f(list.j[k]);
    };
    if (between_bodies_) visit(others_);
    if (!own_.begin.empty()) visit(own_);
  }
  const std::vector<std::pair<int, int>>& near_walls() const { return near_walls_; }

  Neighbors neighbors(int particles) const {
    Neighbors out;
    out.begin.push_back(0);
    for (int i = 0; i < particles; ++i) {
      if (between_bodies_)
        out.j.insert(out.j.end(), others_.j.begin() + others_.begin[i],
                     others_.j.begin() + others_.begin[i + 1]);
      while (out.j.size() % lanes != 0) out.j.push_back(i);
      out.begin.push_back(static_cast<int>(out.j.size()) / lanes);
    }
    return out;
  }

  template <class Archive>
  void serialize(Archive& archive, int particles, int walls) {
    others_.serialize(archive, particles);
    own_.serialize(archive, particles);
    archive.indices(near_walls_, std::pair(particles, walls));
    archive(travelled_);
  }

 private:
  static constexpr double skin = 0.5;  // in spacings

  void search_others(const Particles<Dim>& s, const WallContacts<Dim>& walls) {
    travelled_ = 0;
    if (between_bodies_) others_.search(s);
    near_walls_.clear();
    for (int i = 0; i < s.size(); ++i)
      for (int wall = 0; wall < walls.count(); ++wall)
        if (2 * walls.height(wall, s.x[i]) < (1 + 2 * skin) * dp_) near_walls_.emplace_back(i, wall);
  }

  bool between_bodies_;
  double dp_;  // m
  BodyPairs<Dim> others_;
  OwnPairs<Dim> own_;
  std::vector<std::pair<int, int>> near_walls_;
  double travelled_ = 0;  // path of the fastest particle since search_others, m
};

}  // namespace taut
