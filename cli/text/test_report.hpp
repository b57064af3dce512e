#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

struct TestCase {
  enum class Result { passed, failed, error };
  std::string name;
  Result result = Result::passed;
  std::string text{};  // expected and actual value, or error
  std::optional<double> seconds{};
};

struct TestReport {
  std::string command;
  std::string subject;  // run folder or title
  std::vector<TestCase> cases;
};

std::string junit_xml(const TestReport& report);

/// Annotations of GitHub Actions: at most ten, the limit per step.
std::string github_annotations(const TestReport& report);

}  // namespace taut::cli
