#pragma once

#include <map>
#include <string>
#include <vector>

namespace taut::cli {

/// "og.since.fractured": `since.fractured` of `og`.
struct Quantity {
  std::string run, path;

  std::string name() const { return run + "." + path; }
};

/// Each quantity once, in order.
std::vector<Quantity> quantities_in(const std::string& criterion);

/// Throws UsageError.
void check_criterion(const std::string& criterion, const std::vector<std::string>& runs);

/// Verdicts count as ranks rising from `stable` to `diverged`.
bool is_met(const std::string& criterion, const std::map<std::string, double>& values);

struct QuantityValue {
  // `verdict`: its rank; `since.FAILURE`: first time of the failure in s, infinity if never
  double number = 0;
  std::string shown;  // "0.012 s"
};
/// Throws UsageError for an unknown quantity or a missing value.
QuantityValue value_of(const std::string& folder, const std::string& path);

}  // namespace taut::cli
