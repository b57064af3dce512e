#pragma once

#include <span>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Widest angle between neighbouring directions, rad.
double widest_gap(std::span<double> directions);

/// Counts surface particles inside another body, or inside a part of their own body that was initially far (THEORY.md).
class Penetration {
 public:
  Penetration(const Snapshot& start, double spacing, int threads = 1);
  int operator()(const Snapshot& now);

 private:
  struct Tested {
    int particle, begin, end;  // range in `near_`
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
  std::vector<double> at_search_;  // as Snapshot::x
  std::vector<Tested> tested_;
  std::vector<int> near_;  // far particles around the tested ones
};

}  // namespace taut
