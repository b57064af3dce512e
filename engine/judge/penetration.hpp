#pragma once

#include <span>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// The widest angle between neighbours of these directions (rad, sorted here); a full turn of fewer than two.
double widest_gap(std::span<double> directions);

/// Finds particles that have gone through a surface: a particle lies inside a far part when the particles of
/// that part within 1.5 dp leave no gap wider than 2π/3 around it; in 3D no empty cone as wide as that: each
/// of 98 directions spread over the sphere has one of them within π/3. Far are particles of another body, and
/// those of its own that were more than 4 dp away at the start. A face that touches another one has it on one
/// side: the gap is near π, dented or interlocked by a row too. Behind two particles of a surface that are 1
/// dp apart the gap is 2π/3 at a depth of 0.29 dp; in 3D behind the middle of four it is at 0.41 dp. One that is
/// nearer than that tells no direction: of two faces that touch particle on particle the one is a hair behind the other.
///
/// Only particles of a surface are asked, those that their own neighbours of the start leave such a gap, and
/// of them only those with a far one of a surface within 1.5 dp: where two parts overlap their outlines
/// cross. A body that is inside another without a crossing at any time it is looked at is not found.
///
/// Whom to ask, and about whom, is listed out to 2.5 dp, and again only when two particles can have come 1 dp
/// nearer: by the diagonal of the box of all displacements since, which a common motion leaves small. In a
/// body that is strained little nobody is asked. What is found does not depend on when the lists were made.
class Penetration {
 public:
  Penetration(const Snapshot& start, double spacing, int threads = 1);
  /// How many particles of a surface lie inside a far part, close behind its surface.
  int operator()(const Snapshot& now);

 private:
  struct Asked {
    int particle, begin, end;  // of `near_`
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
  std::vector<int> surface_;  // its particles, in rising order
  std::vector<bool> on_surface_;
  std::vector<double> at_search_;  // Snapshot::x; empty before the first
  std::vector<Asked> asked_;
  std::vector<int> near_;  // far particles that may be near
};

}  // namespace taut
