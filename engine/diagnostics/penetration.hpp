#pragma once

#include <span>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// Widest angle between neighbouring directions, rad, which are sorted here; a full turn for fewer than two.
double widest_gap(std::span<double> directions);

/// Finds particles that have crossed a surface. A particle lies inside a far part if that part's particles within 1.5
/// dp leave no gap wider than 2π/3 around it (3D: no empty cone of this width). Far are other bodies, and particles
/// of the same body initially more than 4 dp away. In touching faces, even interlocked ones, the gap is near π.
/// Particles nearer than the depth at which the gap behind a surface reaches 2π/3 (0.29 dp, in 3D 0.41 dp) are
/// ignored, since their direction means nothing.
/// Only surface particles, which initially have such a gap, are tested, and only near a far surface particle: where
/// parts overlap their outlines cross. A body inside another without an observed crossing is not found.
/// Candidates are listed out to 2.5 dp and updated only when two particles may have approached by 1 dp, the diagonal
/// of the box of all displacements since. The result does not depend on the time of the listing.
class Penetration {
 public:
  Penetration(const Snapshot& start, double spacing, int threads = 1);
  /// Number of surface particles inside a far part, close behind its surface.
  int operator()(const Snapshot& now);

 private:
  struct Asked {
    int particle, begin, end;  // in `near_`
  };

  template <int Dim>
  int count(const Snapshot& now);
  template <int Dim>
  bool lists_hold(const Snapshot& now) const;
  template <int Dim>
  void search(const Snapshot& now);
  template <int Dim>
  std::vector<int> to_ask(const Snapshot& now) const;
  template <int Dim>
  bool is_far(const Snapshot& now, int i, int j) const;
  template <int Dim, class Around>
  bool is_inside(const Snapshot& now, const Asked& asked, Around& around) const;

  double spacing_;            // m
  std::vector<int> surface_;  // ascending ids
  std::vector<bool> on_surface_;
  std::vector<double> at_search_;  // Snapshot::x at the last search; empty before the first
  std::vector<Asked> asked_;
  std::vector<int> near_;  // far particles that may come near
};

}  // namespace taut
