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

  /// Run that replaces the references for this run's scene, or nullptr.
  const StoredRun* reference_of(const StoredRun& run) const;
  std::optional<double> of(const StoredRun& run) const;
  /// Whether the run has a value, with or without a reference.
  bool measured(const StoredRun& run) const;
  bool relative(const StoredRun& run) const;
  /// Unit of the errors; empty for shares of a reference or of a length.
  std::string unit(const StoredRun& run) const;
};

/// Whether both are the same row, or of the same folder.
bool is_same_run(const StoredRun& a, const StoredRun& b);

/// Chooses the measure as make_chart() does.
ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request);

/// "0.5 mm".
std::string shown_spacing(double spacing);

}  // namespace taut::cli
