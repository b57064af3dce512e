#pragma once

#include <span>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Widest angle between neighbouring directions, rad, sorted here; a full turn for fewer than two.
double widest_gap(std::span<double> directions);

/// Finds particles inside a far part: its particles within 1.5 dp leave no gap wider than 2π/3 around them (3D: no
/// empty cone of that width). Far are other bodies, and particles initially more than 4 dp away. Touching faces leave
/// gaps near π. Neighbours within 0.29 dp (3D: 0.41 dp), where the gap behind a surface reaches 2π/3, do not count.
/// Tests surface particles, which initially have such a gap, near far surface particles, because outlines of
/// overlapping parts cross. Misses a body inside another without an observed crossing.
/// Lists candidates out to 2.5 dp, until two particles may have approached by 1 dp, the diagonal of the box of
/// displacements.
class Penetration {
 public:
  Penetration(const Snapshot& start, double spacing, int threads = 1);
  /// Returns the number of such particles.
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
  std::vector<double> at_search_;  // Snapshot::x; initially empty
  std::vector<Tested> tested_;
  std::vector<int> near_;  // far candidates
};

}  // namespace taut
