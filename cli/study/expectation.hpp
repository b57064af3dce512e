#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/stored_results.hpp"

namespace taut::cli {

/// How far a number may be from what is expected.
struct Tolerance {
  double size = 0;
  bool relative = false;  // a share of what is expected
};
/// "1%" or "0.002". Throws UsageError for anything else; `option` is what it was given with.
Tolerance parse_tolerance(const std::string& text, const std::string& option);

/// What a number of a run should be.
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
/// Every measure that has a value in `baseline`, as it is there.
std::vector<Expectation> expectations_of(const StoredRun& baseline, const Tolerance& tolerance);

/// What came of an expectation, as a table shows it.
struct Finding {
  std::string name, expected, is, difference;
  bool fine = false;
};
/// A number that the run has not, as a measure of a run that was too short, is not fine. Throws UsageError
/// for a name that run.json has not, with the nearest ones.
Finding find_out(const StoredRun& run, const Expectation& expected);
/// That the verdict is no worse than `worst`.
Finding find_out_verdict(const StoredRun& run, const std::string& worst);
/// That the run went to its end.
Finding find_out_end(const StoredRun& run);

/// For people.
std::string findings_table(const std::vector<Finding>& findings);

}  // namespace taut::cli
