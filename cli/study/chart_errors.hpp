#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// Errors of a measure, against the scene's references or against runs.
struct ChartErrors {
  std::string measure;
  std::vector<const StoredRun*> against{};  // one reference per swept scene
  std::vector<std::string> swept{};         // names in which these scenes differ

  /// nullptr if there is none.
  const StoredRun* reference_of(const StoredRun& run) const;
  std::optional<double> of(const StoredRun& run) const;
  /// Whether there is a value, with or without a reference.
  bool measured(const StoredRun& run) const;
  bool relative(const StoredRun& run) const;
  /// Empty: a share.
  std::string unit(const StoredRun& run) const;
};

ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request);

/// "measures.period.error".
std::string measure_column(const std::string& measure, std::string_view what);
/// "0.5 mm".
std::string shown_spacing(double spacing);

}  // namespace taut::cli
