#include <algorithm>
#include <filesystem>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/study/expectation.hpp"
#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct CheckArguments {
  std::string run, baseline, tolerance, verdict;
  std::vector<std::string> measures;
};

std::vector<Finding> findings(const CheckArguments& o, const StoredRun& run) {
  std::optional<Tolerance> tolerance;
  if (!o.tolerance.empty()) tolerance = parse_tolerance(o.tolerance, "--tolerance");
  std::vector<Expectation> expected;
  for (const std::string& text : o.measures) expected.push_back(parse_expectation(text, tolerance));
  std::vector<Finding> all{find_out_end(run)};
  if (!o.baseline.empty()) {
    if (!tolerance) throw UsageError("--baseline needs --tolerance, such as --tolerance 1%");
    const StoredRun baseline = read_stored_run(o.baseline);
    if (!find_out_end(baseline).fine)
      throw UsageError("the baseline '" + o.baseline +
                       "' is a run that has not finished; give a finished one");
    if (baseline.text("scene") != run.text("scene"))
      throw UsageError("the baseline is a run of scene '" + baseline.text("scene") +
                       "', the run is of scene '" + run.text("scene") + "'; both must be of one scene");
    for (const Expectation& e : expectations_of(baseline, *tolerance)) expected.push_back(e);
    if (o.verdict.empty()) all.push_back(find_out_verdict(run, baseline.text("verdict")));
  }
  if (!o.verdict.empty()) all.push_back(find_out_verdict(run, o.verdict));
  for (const Expectation& e : expected) all.push_back(find_out(run, e));
  if (all.size() == 1) throw UsageError("nothing to check: give --measure, --baseline or --verdict");
  return all;
}

int check(const CheckArguments& options, std::ostream& out) {
  const std::vector<Finding> all = findings(options, read_stored_run(options.run));
  const auto failed = std::ranges::count(all, false, &Finding::fine);
  out << findings_table(all) << '\n'
      << (failed == 0 ? "fine"
                      : std::to_string(failed) + " of " + std::to_string(all.size()) + " checks failed")
      << '\n';
  return failed == 0 ? exit_fine : exit_different;
}

}  // namespace

std::function<int(Streams)> declare_check(Options& command) {
  auto options = std::make_shared<CheckArguments>();
  command.add_argument("DIR", options->run, "folder of a run, or its run.json").required();
  command.add("--measure", "MEASURE ...", options->measures,
              "an expected value NAME=VALUE±TOLERANCE (also +-; the tolerance in % or in the unit of the "
              "measure) or a bound NAME<VALUE, NAME>VALUE; also of a number in run.json, such as "
              "conservation.energy<1e-3");
  command.add("--baseline", "FILE", options->baseline,
              "folder or run.json of another run, whose measures and verdict are expected");
  command.add("--tolerance", "X", options->tolerance,
              "for measures without one of their own, and for --baseline");
  command.add("--verdict", "stable|VERDICT", options->verdict,
              "the worst verdict that is allowed, such as stable");
  return [options](Streams streams) { return check(*options, streams.out); };
}

}  // namespace taut::cli
