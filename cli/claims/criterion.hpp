#pragma once

#include <map>
#include <string>
#include <vector>

namespace taut::cli {

/// A quantity of a run in a criterion: "og.since.fractured" is `since.fractured` of the run `og`.
struct Quantity {
  std::string run, path;

  std::string name() const { return run + "." + path; }
};

/// Quantities in an expression, each once, in their order.
std::vector<Quantity> quantities_in(const std::string& criterion);

/// Throws UsageError for an invalid expression and for an unknown run, with the nearest name.
void check_criterion(const std::string& criterion, const std::vector<std::string>& runs);

/// Whether the criterion is true for these values of its quantities, by name. Verdicts are numbers: `stable` to
/// `diverged`.
bool is_met(const std::string& criterion, const std::map<std::string, double>& values);

struct QuantityValue {
  double number = 0;  // of a verdict its rank; of a failure its beginning in s, infinite if it never began
  std::string shown;  // with unit
};
/// Value of `path` in a run folder. Throws UsageError for an unknown quantity, with the nearest names, and for a
/// measure without value.
QuantityValue value_of(const std::string& folder, const std::string& path);

}  // namespace taut::cli
