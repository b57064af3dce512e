#pragma once

#include <vector>

#include "engine/core/point.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Greatest value and first time of a ratio above its bound.
struct Excess {
  double greatest = 0;  // 0: never above
  double since = 0;     // s
};

/// Compares the energy of groups of bodies with their received energy (THEORY.md).
class EnergyTest {
 public:
  /// `support`: range of interaction, m. The scene must outlive the test.
  EnergyTest(const Scene& scene, const Snapshot& start, double support, bool keeps_neighbors);

  /// Call in the order of time.
  bool diverges(const Snapshot& now);

  /// Ratio of energy to received energy, where above 1.1.
  const Excess& gain() const { return gain_; }
  /// Change of a closed group's angular momentum relative to its greatest √(moment of inertia · 2 kinetic energy),
  /// where above 0.01.
  const Excess& turn() const { return turn_; }

  template <class Archive>
  void serialize(Archive& archive) {
    const std::size_t bodies = group_.size();
    archive(group_, at_wall_, fell_, most_work_, spin_scale_, gain_.greatest, gain_.since, turn_.greatest,
            turn_.since, last_time_);
    archive.check("the groups of a verdict", [&] {
      for (const std::size_t size :
           {group_.size(), at_wall_.size(), fell_.size(), most_work_.size(), spin_scale_.size()})
        if (size != bodies) return false;
      for (std::size_t b = 0; b < bodies; ++b)
        if (group_[b] < 0 || group_[b] > static_cast<int>(b)) return false;
      return true;
    });
    for (Sums& sums : last_) archive(sums.centre, sums.low, sums.high, sums.fastest);
  }

 private:
  struct Sums {
    double mass = 0, kinetic = 0, strain = 0;
    Point momentum{}, spin{};  // kg m/s; kg m²/s about the origin
    Point centre{};            // of mass, m
    double inertia = 0;        // Σ m |x − centre|², kg m²
    Point low{}, high{};       // bounding box, m
    double fastest = 0;        // greatest speed relative to the first particle, m/s
  };
  struct Group {
    double mass = 0, kinetic = 0, strain = 0, start_strain = 0, start_kinetic = 0, work = 0;
    Point momentum{}, start_momentum{};
    bool closed = true, meets = false;
  };

  template <int Dim>
  void add_up(const Snapshot& now, std::vector<Sums>& all) const;
  std::vector<Sums> sums(const Snapshot& now) const;
  double work(const Snapshot& now, std::size_t body) const;
  void merge(const std::vector<Sums>& now, double time);
  bool may_meet(std::size_t a, std::size_t b, const std::vector<Sums>& now, double time) const;
  bool may_touch_wall(std::size_t b, const std::vector<Sums>& now, double time) const;
  std::vector<Group> groups(const std::vector<Sums>& now) const;
  void watch_turn(const std::vector<Group>& all, const std::vector<Sums>& now, double time);

  const Scene* scene_;
  double reach_;  // contact range, m
  bool keeps_neighbors_;
  double rounding_;                             // J/kg
  double start_contact_;                        // J
  std::vector<std::size_t> first_;              // [body + 1] first particle
  std::vector<bool> is_acted_on_;               // [body]
  std::vector<Sums> start_, last_;              // [body]
  double last_time_ = 0;                        // s
  std::vector<int> group_;                      // [body] lowest body of its group
  std::vector<unsigned char> at_wall_, fell_;   // [body]; fell_ of the lowest body of a group
  std::vector<double> most_work_, spin_scale_;  // [body] J; kg m²/s
  Excess gain_, turn_;
};

}  // namespace taut
