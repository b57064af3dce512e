#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/judge/energies.hpp"
#include "engine/judge/penetration.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

/// From best to worst; the verdict of a run is the worst that ever held.
enum class Verdict { stable, hourglass, penetrated, fractured, diverged };
std::string_view name(Verdict);
/// None if there is no verdict of that name.
std::optional<Verdict> find_verdict(std::string_view name);
/// From `stable` to the worst; and without `stable`.
std::vector<std::string> names_of_verdicts();
std::vector<std::string> names_of_failures();

/// Hourglass error (engine/diagnostics/indicators.hpp) from which particles zigzag. What the papers show as
/// smooth stays below 0.012: `enog` on plate, rings and ball-plate 0.0004, 0.0015, 0.0027 ([Zhang2024] Fig.
/// 3, 12, 18), the `tic` methods on the rotating plate 0.012 ([Khayyer2024] Fig. 9, 10). What they show to
/// zigzag is above 0.04: `og` on the plate 0.081 at 0.012 s ([Zhang2024] Fig. 6), `oas` on the rings 0.09,
/// 0.13 and 0.17 at 0.06, 0.07 and 0.08 c0, and on ball-plate 0.12 (Fig. 12-14, 18), no artificial stress at
/// the surface 0.10 ([Khayyer2024] Fig. 13), `pf` and `tl` on the rotating plate 0.19 and 0.042 ([Lee2016]
/// Fig. 11). 0.03 lies between. Smooth bending counts only where it is as sharp as the spacing: strips of one
/// to three rows bent to a radius of 1, 2, 4 and 8 dp give 0.06 to 0.09, 0.011 to 0.014, 0.002 to 0.003 and
/// below 0.001. It is the mean over a body that is judged: creases add to it by their share of the particles.
/// The checkerboard shares of the stress are not judged: without any zigzag they are high where stress is low
/// or its fronts are sharp, as for `enog` on ball-plate with 0.35 of the pressure, and wherever they are high
/// for another reason the hourglass error is above 0.03 too.
inline constexpr double hourglass_threshold = 0.03;

/// Where bonds are drawn out further than the method follows its law of elasticity.
struct BeyondLaw {
  double share = 0;  // of the bonds, the greatest so far
  double since = 0;  // s
};

/// Judges a run at given times.
///
/// hourglass: the hourglass error is above its threshold.
/// penetrated: a particle lies inside another body, or inside a far part of its own; see Penetration.
/// connectivity: a bond joins two particles of one body that are at most 1.5 dp apart as they are laid; it is
///   broken while it is longer than max(support, 2 dp), since a method that searches its neighbours has lost
///   it then. Where they are kept a body of three rows and more may be drawn out as far as its law allows: a
///   bond of that length is broken if it stands out, stretched over 1.5 times as much as what goes on straight
///   from its ends. Cracks one row apart, between which all bonds are opened alike, are not seen so.
///   Fractured = more pieces of the graph of unbroken bonds than at the start ("at the start", not "bodies":
///   a body may consist of parts), or a broken bond whose ends are more than 8 unbroken bonds apart: a crack
///   at least five particles deep. A ring that is cut once stays one piece.
/// energy: the run diverged when a value is not finite, or when the energy of a body departs from the energy that it
///   received; see EnergyTest.
class Judge {
 public:
  Judge(const Scene& scene, const Snapshot& start, double support, bool keeps_neighbors, int threads = 1);
  Judge(const Scene& scene, const Simulation& simulation);
  /// Takes the state at one time into account and remembers when each failure began. Without readings its
  /// zigzags are not judged.
  void observe(const Snapshot& now, const Balance& balance, const Readings& readings = {});

  Verdict verdict() const;
  /// The first time of each failure, s; those that never held are absent.
  const std::map<Verdict, double>& since() const { return since_; }
  int pieces() const { return pieces_; }  // of the graph of unbroken bonds, when last observed
  const BeyondLaw& beyond_law() const { return beyond_law_; }
  const Excess& energy_gain() const { return energies_.gain(); }
  const Excess& turn() const { return energies_.turn(); }

  /// What it has seen so far; the rest comes from the start.
  template <class Archive>
  void serialize(Archive& archive) {
    for (Bond& bond : bonds_) archive(bond.broken);
    archive(pieces_, beyond_law_.share, beyond_law_.since, since_);
    energies_.serialize(archive);
    archive.check("a verdict", [&] {
      const auto is_failure = [](const auto& failure) {
        return failure.first > Verdict::stable && failure.first <= Verdict::diverged;
      };
      return std::all_of(since_.begin(), since_.end(), is_failure);
    });
  }

 private:
  struct Bond {
    int i, j;
    bool broken;  // when last observed
  };
  /// True if a bond broke or healed since.
  bool update_broken(const Snapshot& now);
  template <int Dim>
  bool update_broken_in(const Snapshot& now);
  template <int Dim>
  bool stands_out(const Bond& bond, const Snapshot& now) const;
  double compliance(const Bond& bond, const Snapshot& now) const;
  template <int Dim>
  static double squared_stretch(const Bond& bond, const Snapshot& now);
  int count_pieces() const;
  bool has_crack() const;
  bool bypassed(int bond, std::vector<int>& seen) const;

  std::vector<double> compliance_;  // [material] 1/Young's modulus, 1/Pa
  std::vector<Bond> bonds_;
  std::vector<int> first_of_;  // [particles + 1] where in bonds_of_ those of each begin
  std::vector<int> bonds_of_;  // indices
  std::size_t particles_ = 0;
  double longest_ = 0;  // m, up to which a bond is never broken
  bool keeps_neighbors_ = false;
  int start_pieces_ = 0;
  int pieces_ = 0;
  double lawful_stretch_ = std::numeric_limits<double>::infinity();
  double shortest_ = 0;  // m, of a bond before any displacement
  BeyondLaw beyond_law_;
  EnergyTest energies_;
  Penetration penetration_;
  std::map<Verdict, double> since_;
};

}  // namespace taut
