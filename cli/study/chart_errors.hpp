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

  /// The run in `against` with the scene of `run`, or nullptr.
  const StoredRun* reference_of(const StoredRun& run) const;
  std::optional<double> of(const StoredRun& run) const;
  bool measured(const StoredRun& run) const;
  bool relative(const StoredRun& run) const;
  /// Empty for shares.
  std::string unit(const StoredRun& run) const;
};

/// The same row or folder.
bool is_same_run(const StoredRun& a, const StoredRun& b);

ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request);

/// "0.5 mm".
std::string shown_spacing(double spacing);

}  // namespace taut::cli
