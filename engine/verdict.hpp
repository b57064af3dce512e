#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/measures.hpp"
#include "engine/simulation.hpp"

namespace taut {

/// From best to worst; the verdict of a run is the worst that ever held.
enum class Verdict { stable, fractured, diverged };
std::string_view name(Verdict);
/// None if there is no verdict of that name.
std::optional<Verdict> find_verdict(std::string_view name);

/// Watches a run at history times.
///
/// connectivity: a bond joins two particles of one body that are at most 1.5 dp apart at the start; it is
///   broken while it is longer than max(support, 2 dp). Fractured = more pieces of the graph of unbroken
///   bonds than at the start ("at the start", not "bodies": a body may consist of parts), or a broken bond
///   whose ends are more than 8 unbroken bonds apart: a crack at least five particles deep. A ring that is
///   cut once stays one piece.
/// energy: kinetic + strain above twice what was given, or anything that is not finite = diverged. Given is
///   the start's and the work of drives, loads and gravity, at its greatest so far: what takes energy back
///   may leave noise, not more. A scene that is given none is judged by finiteness only.
class Judge {
 public:
  Judge(const Scene& scene, const Snapshot& start, double support);
  /// Looks at the state at one time and remembers when each failure began.
  void look(const Snapshot& now, const Balance& balance);

  Verdict verdict() const;
  /// The first time of each failure, s; those that never held are absent.
  const std::map<Verdict, double>& since() const { return since_; }
  int pieces() const { return pieces_; }  // of the graph of unbroken bonds, at the last look

  /// What it has seen so far; the rest comes from the start.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(bonds_, given_energy_, pieces_, since_);
  }

 private:
  struct Bond {
    int i, j;
    bool broken;  // at the last look
  };
  /// True if a bond broke or healed since the last look.
  bool update_broken(const Snapshot& now);
  int count_pieces() const;
  bool has_crack() const;
  bool bypassed(int bond, std::vector<int>& seen) const;

  std::vector<Bond> bonds_;
  std::vector<std::vector<int>> bonds_of_;  // [particle] indices
  std::size_t particles_ = 0;
  double longest_ = 0;       // m, of an unbroken bond
  double start_energy_ = 0;  // J
  double given_energy_ = 0;  // J, greatest so far
  int start_pieces_ = 0;
  int pieces_ = 0;
  std::map<Verdict, double> since_;
};

}  // namespace taut
