#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/stored_results.hpp"

namespace taut::cli {

/// Allowed distance of a number from the expected value.
struct Tolerance {
  double size = 0;
  bool relative = false;  // a share of the expected value
};
/// Reads "1%" or "0.002". Throws UsageError, which names `option`, for anything else.
Tolerance parse_tolerance(const std::string& text, const std::string& option);

/// The value or the bound expected of a number of a run.
struct Expectation {
  enum class Kind { equal, below, above };
  std::string name;  // of a measure, or a path in run.json: "conservation.energy"
  Kind kind = Kind::equal;
  bool or_equal = false;  // of a bound
  double value = 0;       // in the unit of the measure
  Tolerance tolerance{};
};

/// "period=0.2545±1%", "period=0.2545+-0.002", "period=0.2545" with the tolerance that holds for all,
/// "period<0.26", "period>=0.25". Throws UsageError.
Expectation parse_expectation(const std::string& text, const std::optional<Tolerance>& for_all);
/// The values of all measures of `baseline`.
std::vector<Expectation> expectations_of(const StoredRun& baseline, const Tolerance& tolerance);

/// Result of one expectation: a row of the table.
struct Finding {
  std::string name, expected, is, difference;
  bool fine = false;
  bool bound = false;             // expected: a bound, which is violated, not a value, which has moved
  std::optional<double> value{};  // behind `is`, if it is a finite number
};
/// A measure without a value, for instance of a run that was too short, is not fine. Throws UsageError for a name
/// that run.json lacks, with the nearest names.
Finding find_out(const StoredRun& run, const Expectation& expected);
/// Checks that the verdict is no worse than `worst`.
Finding find_out_verdict(const StoredRun& run, const std::string& worst);
/// Checks that the run has finished.
Finding find_out_end(const StoredRun& run);

/// For people.
std::string findings_table(const std::vector<Finding>& findings);

}  // namespace taut::cli
