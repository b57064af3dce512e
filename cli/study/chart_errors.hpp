#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"

namespace taut::cli {

struct ChartErrors {
  std::string measure;
  std::vector<const StoredRun*> against{};  // one per swept scene; empty: references
  std::vector<std::string> swept{};         // names in which the scenes differ
  bool relative = false;                    // all errors are shares of references other than 0

  /// Relative if any of `runs` has a relative error.
  void choose_kind(const std::vector<StoredRun>& runs);
  /// The run in `against` with the scene of `run`, or nullptr.
  const StoredRun* reference_of(const StoredRun& run) const;
  /// Nullopt also for an error of the other kind.
  std::optional<double> of(const StoredRun& run) const;
  bool measured(const StoredRun& run) const;
  /// False for an error of the other kind.
  bool comparable(const StoredRun& run) const;
  /// Empty for shares.
  std::string unit(const StoredRun& run) const;

 private:
  bool is_relative(const StoredRun& run) const;
  std::optional<double> of_any_kind(const StoredRun& run) const;
};

/// The same row or folder.
bool is_same_run(const StoredRun& a, const StoredRun& b);

ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request);

/// "0.5 mm".
std::string shown_spacing(double spacing);

}  // namespace taut::cli
