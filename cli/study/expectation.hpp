#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/stored_results.hpp"

namespace taut::cli {

struct Tolerance {
  double size = 0;
  bool relative = false;  // share of the expected value
};
/// "1%" or "0.002". Throws UsageError.
Tolerance parse_tolerance(const std::string& text, const std::string& option);

struct Expectation {
  enum class Kind { equal, below, above };
  std::string name;  // measure or path: "conservation.energy"
  Kind kind = Kind::equal;
  bool or_equal = false;  // for bounds
  double value = 0;       // in the measure's unit
  Tolerance tolerance{};
};

/// Parses "period=0.2545±1%", "period=0.2545+-0.002", "period=0.2545" (tolerance `for_all`), "period>=0.25". Throws
/// UsageError.
Expectation parse_expectation(const std::string& text, const std::optional<Tolerance>& for_all);
std::vector<Expectation> expectations_of(const StoredRun& baseline, const Tolerance& tolerance);

struct Finding {
  std::string name, expected, is, difference;
  bool fine = false;
  bool bound = false;
  std::optional<double> value{};  // `is`, if finite
};
/// A measure without a value fails. Throws UsageError for an unknown name.
Finding check_expectation(const StoredRun& run, const Expectation& expected);
Finding check_verdict(const StoredRun& run, const std::string& worst);
Finding check_end(const StoredRun& run);

std::string findings_table(const std::vector<Finding>& findings);

}  // namespace taut::cli
