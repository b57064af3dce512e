#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/chart.hpp"

namespace taut::cli {

/// What the runs of a chart are judged by: one measure, against the references of the scene or against runs.
struct ChartErrors {
  std::string measure;
  std::vector<const StoredRun*> against{};  // stand for references, one for each scene that was swept
  std::vector<std::string> swept{};         // the names in which those scenes differ

  /// nullptr: there is none of this run's scene.
  const StoredRun* reference_of(const StoredRun& run) const;
  std::optional<double> of(const StoredRun& run) const;
  /// There is a value, with or without something to compare it with, or there would be but for a reference.
  bool measured(const StoredRun& run) const;
  /// They are shares of a reference.
  bool relative(const StoredRun& run) const;
  /// Empty: a share of the reference or of a length.
  std::string unit(const StoredRun& run) const;
};

/// As make_chart() chooses it.
ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request);

/// The name of a column: "measures.period.error".
std::string measure_column(const std::string& measure, std::string_view what);
/// "0.5 mm"
std::string shown_spacing(double spacing);

}  // namespace taut::cli
