#pragma once

#include <span>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Widest angle between neighbouring directions, rad, sorted here; a full turn for fewer than two.
double widest_gap(std::span<double> directions);

/// Finds particles that have passed through a surface. A particle lies inside a far part if the particles of that
/// part within 1.5 dp leave no gap wider than 2π/3 around it (3D: no empty cone with this opening angle). Far
/// particles belong to another body, or were initially more than 4 dp away. A touching face leaves a gap near π. Far
/// particles nearer than 0.29 dp (3D: 0.41 dp) do not count: behind a surface the gap reaches 2π/3 only at this
/// depth.
/// Only surface particles, which have such a gap among their initial neighbours, are tested, near far surface
/// particles. A body inside another one is missed if no observed state shows the crossing.
/// Candidates are listed out to 2.5 dp. The lists are renewed once two particles may have approached each other by 1
/// dp; results do not depend on the time of renewal.
class Penetration {
 public:
  Penetration(const Snapshot& start, double spacing, int threads = 1);
  /// Returns the number of surface particles inside a far part.
  int operator()(const Snapshot& now);

 private:
  struct Tested {
    int particle, begin, end;  // of `near_`
  };

  template <int Dim>
  int count(const Snapshot& now);
  template <int Dim>
  bool lists_hold(const Snapshot& now) const;
  template <int Dim>
  void search(const Snapshot& now);
  template <int Dim>
  std::vector<int> particles_to_test(const Snapshot& now) const;
  template <int Dim>
  bool is_far(const Snapshot& now, int i, int j) const;
  template <int Dim, class Around>
  bool is_inside(const Snapshot& now, const Tested& tested, Around& around) const;

  double spacing_;            // m
  std::vector<int> surface_;  // ascending
  std::vector<bool> on_surface_;
  std::vector<double> at_search_;  // Snapshot::x
  std::vector<Tested> tested_;
  std::vector<int> near_;
};

}  // namespace taut
