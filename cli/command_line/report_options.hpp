#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"

namespace taut::cli {

class Options;

struct ReportOptions {
  bool json = false;
  std::string junit;  // file, or empty

  void declare_json(Options& command);
  void declare_junit(Options& command);
  /// Writes the JUnit file and, within GitHub Actions, annotations to `err`. Throws OutputError.
  void publish(const TestReport& report, std::ostream& err) const;
};

Json json_answer(std::string_view command);

}  // namespace taut::cli
