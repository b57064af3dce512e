#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

class Options;

/// --json and --junit as typed.
struct ReportOptions {
  bool json = false;
  std::string junit;  // file; empty: none

  void declare_json(Options& command);
  void declare_junit(Options& command);
  /// Writes the JUnit file if there is one and, on GitHub, prints failures as annotations to `err`. Throws
  /// OutputError.
  void publish(const TestReport& report, std::ostream& err) const;
};

/// The first keys of the JSON object that `command` prints: version of taut, name of the command, format number.
Json json_answer(std::string_view command);

}  // namespace taut::cli
