#include "cli/command_line/report_options.hpp"

#include <cstdlib>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"

namespace taut::cli {

void ReportOptions::declare_json(Options& command) {
  command.add_flag("--json", json, "print one JSON object, for scripts");
}

void ReportOptions::declare_junit(Options& command) {
  command.add("--junit", "FILE", junit, "write the results as JUnit XML, for test tools");
}

void ReportOptions::publish(const TestReport& report, std::ostream& err) const {
  const char* const github = std::getenv("GITHUB_ACTIONS");
  if (github && github == std::string_view("true")) err << github_annotations(report);
  if (junit.empty()) return;
  make_folder_of(junit);
  write_atomically(junit, junit_xml(report));
}

Json json_answer(std::string_view command) {
  return {{"taut", build_info.version}, {"answer", std::string(command)}, {"format", 1}};
}

}  // namespace taut::cli
