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

/// Verdicts from best to worst; a run gets the worst that applies.
enum class Verdict { stable, hourglass, penetrated, fractured, diverged };
std::string_view name(Verdict);
std::optional<Verdict> find_verdict(std::string_view name);
std::vector<std::string> names_of_verdicts();
std::vector<std::string> names_of_failures();

/// Hourglass errors of runs of [Zhang2024], [Khayyer2024] and [Lee2016] are below 0.012 if the paper's figures are
/// smooth, and above 0.04 if they show zigzags.
inline constexpr double hourglass_threshold = 0.03;

/// Bonds stretched beyond the range of the method's elastic law.
struct BeyondLaw {
  double share = 0;  // greatest share of the bonds
  double since = 0;  // s
};

/// Judges a run (THEORY.md).
class Judge {
 public:
  /// The scene must outlive the judge.
  Judge(const Scene& scene, const Snapshot& start, double support, bool keeps_neighbors, int threads = 1);
  Judge(const Scene& scene, const Simulation& simulation);
  /// Without `readings`, hourglass is not judged.
  void observe(const Snapshot& now, const Balance& balance, const Readings& readings = {});

  Verdict verdict() const;
  /// First time of each failure, s.
  const std::map<Verdict, double>& since() const { return since_; }
  int pieces() const { return pieces_; }  // of the graph of unbroken bonds
  const BeyondLaw& beyond_law() const { return beyond_law_; }
  const Excess& energy_gain() const { return energies_.gain(); }
  const Excess& turn() const { return energies_.turn(); }

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
    bool broken;
  };
  /// Returns whether a bond broke or healed.
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

  std::vector<double> compliance_;  // [material] 1/Pa
  std::vector<Bond> bonds_;
  std::vector<int> first_of_;  // [particle + 1] index in bonds_of_
  std::vector<int> bonds_of_;
  std::size_t particles_ = 0;
  double longest_ = 0;  // m; shorter bonds are unbroken
  bool keeps_neighbors_ = false;
  int start_pieces_ = 0;
  int pieces_ = 0;
  double lawful_stretch_ = std::numeric_limits<double>::infinity();
  double shortest_ = 0;  // initial bond length, m
  BeyondLaw beyond_law_;
  EnergyTest energies_;
  Penetration penetration_;
  std::map<Verdict, double> since_;
};

}  // namespace taut
