#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// One result of a command as test tools show it: a check, a picture or a run.
struct TestCase {
  enum class Result { passed, failed, error };
  std::string name;
  Result result = Result::passed;
  std::string text{};  // expected and actual value, or the reason of an error
  std::optional<double> seconds{};
};

/// The results of one call of a command.
struct TestReport {
  std::string command;  // "check"
  std::string subject;  // run folder or title
  std::vector<TestCase> cases;
};

/// A JUnit XML file with one test suite. Replaces bytes and letters that XML cannot contain.
std::string junit_xml(const TestReport& report);

/// The first ten failures and errors as workflow commands of GitHub Actions, which limits a step to ten.
std::string github_annotations(const TestReport& report);

}  // namespace taut::cli
