#include <algorithm>
#include <filesystem>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/study/expectation.hpp"
#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct CheckArguments : ReportOptions {
  std::string run, baseline, tolerance, verdict;
  std::vector<std::string> measures;
};

std::vector<Finding> findings(const CheckArguments& o, const StoredRun& run) {
  std::optional<Tolerance> tolerance;
  if (!o.tolerance.empty()) tolerance = parse_tolerance(o.tolerance, "--tolerance");
  std::vector<Expectation> expected;
  for (const std::string& text : o.measures) expected.push_back(parse_expectation(text, tolerance));
  std::vector<Finding> all{check_end(run)};
  if (!o.baseline.empty()) {
    if (!tolerance) throw UsageError("--baseline needs --tolerance, such as --tolerance 1%");
    const StoredRun baseline = read_stored_run(o.baseline);
    if (!check_end(baseline).fine)
      throw UsageError(
          fmt::format("the baseline '{}' is a run that has not finished; give a finished one", o.baseline));
    if (baseline.record.scene != run.record.scene)
      throw UsageError(fmt::format(
          "the baseline has the scene '{}', but the run has the scene '{}'; the scenes must be the same",
          baseline.record.scene, run.record.scene));
    for (const Expectation& e : expectations_of(baseline, *tolerance)) expected.push_back(e);
    if (o.verdict.empty()) all.push_back(check_verdict(run, baseline.verdict()));
  }
  if (!o.verdict.empty()) all.push_back(check_verdict(run, o.verdict));
  for (const Expectation& e : expected) all.push_back(check_expectation(run, e));
  if (all.size() == 1) throw UsageError("nothing to check: give --measure, --baseline or --verdict");
  return all;
}

std::string text(const std::vector<Finding>& all) {
  const auto failed = std::ranges::count(all, false, &Finding::fine);
  return fmt::format("{}\n{}\n", findings_table(all),
                     failed == 0 ? "fine" : fmt::format("{} of {} checks failed", failed, all.size()));
}

Json json(const CheckArguments& options, const std::vector<Finding>& all) {
  Json answer = json_answer("check");
  answer["run"] = options.run;
  answer["passed"] = std::ranges::all_of(all, &Finding::fine);
  answer["checks"] = Json::array();
  for (const Finding& f : all)
    answer["checks"].add({{"name", f.name},
                          {"passed", f.fine},
                          {"expected", f.expected},
                          {"is", f.is},
                          {"value", f.value},
                          {"difference", f.difference}});
  return answer;
}

TestReport report(const CheckArguments& options, const std::vector<Finding>& all) {
  TestReport report{"check", options.run, {}};
  for (const Finding& f : all)
    report.cases.push_back({fmt::format("{} {}", f.name, f.expected),
                            f.fine ? TestCase::Result::passed : TestCase::Result::failed,
                            fmt::format("{}: expected {}, is {}{}", f.name, f.expected, f.is,
                                        f.difference.empty() ? "" : fmt::format(" ({})", f.difference))});
  return report;
}

int check(const CheckArguments& options, Streams streams) {
  const std::vector<Finding> all = findings(options, read_stored_run(options.run));
  streams.out << (options.json ? json(options, all).dump(2) + "\n" : text(all));
  options.publish(report(options, all), streams.err);
  return std::ranges::all_of(all, &Finding::fine) ? exit_fine : exit_different;
}

}  // namespace

std::function<int(Streams)> declare_check(Options& command) {
  auto options = std::make_shared<CheckArguments>();
  command.add_argument("DIR", options->run, "folder of a run, or its run.json").required();
  command.add("--measure", "MEASURE ...", options->measures,
              "an expected value NAME=VALUE±TOLERANCE (also +-; "
              "the tolerance in % or in the unit of the measure) or a bound NAME<VALUE, NAME>VALUE; "
              "NAME can also be a number in run.json, such as conservation.energy<1e-3");
  command.add("--baseline", "FILE", options->baseline,
              "folder or run.json of another run, whose measures and verdict are expected");
  command.add("--tolerance", "X", options->tolerance,
              "tolerance of --baseline, and of each --measure that has none of its own");
  command.add("--verdict", "stable|VERDICT", options->verdict,
              "the worst verdict that is allowed, such as stable");
  options->declare_json(command);
  options->declare_junit(command);
  return [options](Streams streams) { return check(*options, streams); };
}

}  // namespace taut::cli
