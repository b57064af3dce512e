#include <algorithm>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/claims/claim_tables.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/sweep/runner.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/terminal_columns.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/suggest.hpp"
#include "engine/core/machine.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct ClaimsArguments : ReportOptions {
  std::string what;
  std::vector<std::string> run;
  bool quick = false, all = false, markdown = false, quiet = false;
  std::string out = "out/claims";
  std::optional<int> jobs;

  bool runs() const { return quick || all || !run.empty(); }
};

using Claims = std::vector<const Claim*>;

std::vector<Paper> read_papers(const std::string& what) {
  if (what.ends_with(".toml")) return {read_paper(find_paper(what))};
  return shipped_papers();
}

Claims all_of(const std::vector<Paper>& papers) {
  Claims all;
  for (const Paper& paper : papers)
    for (const Claim& claim : paper.claims) all.push_back(&claim);
  return all;
}

/// `given`: PAPER.KEY, or with `paper` only KEY.
const Claim* find_claim(const Claims& among, const std::string& given, const std::string& paper) {
  const auto found = std::ranges::find_if(among, [&](const Claim* claim) {
    return claim->name() == given || (!paper.empty() && claim->key == given);
  });
  if (found != among.end()) return *found;
  std::vector<std::string> names;
  for (const Claim* claim : among) names.push_back(claim->name());
  throw UsageError(unknown_name("claim", given, names) + "; `taut claims` lists all");
}

Claims select(const std::vector<Paper>& papers, const std::string& what) {
  Claims claims = all_of(papers);
  if (what.empty() || what.ends_with(".toml")) return claims;
  if (what.find('.') != std::string::npos) return {find_claim(claims, what, "")};
  std::vector<std::string> keys;
  for (const Paper& paper : papers) keys.push_back(paper.key);
  if (std::ranges::find(keys, what) == keys.end()) throw UsageError(unknown_name("paper", what, keys));
  std::erase_if(claims, [&](const Claim* claim) { return claim->paper != what; });
  return claims;
}

Claims claims_to_run(const ClaimsArguments& o, const Claims& claims) {
  Claims chosen;
  for (const std::string& name : o.run) chosen.push_back(find_claim(claims, name, o.what));
  if (o.run.empty())
    std::ranges::copy_if(claims, std::back_inserter(chosen),
                         [&](const Claim* c) { return o.all || c->quick; });
  return chosen;
}

void print_json(const Claims& claims, const std::vector<ClaimOutcome>& outcomes, std::ostream& out) {
  Json answer = json_answer("claims");
  if (!outcomes.empty()) answer["passed"] = std::ranges::all_of(outcomes, &ClaimOutcome::agrees);
  answer["claims"] = Json::array();
  for (std::size_t k = 0; k < claims.size(); ++k)
    answer["claims"].add(claim_json(*claims[k], k < outcomes.size() ? &outcomes[k] : nullptr));
  out << answer.dump(2) << '\n';
}

int run_claims(const ClaimsArguments& o, const Claims& claims, Streams streams) {
  if (o.jobs) check_threads(*o.jobs, "--jobs");
  const FolderLock lock(o.out, FolderLock::Of::sweep, "taut claims", streams.err);
  const Interrupts interrupts;
  std::vector<PlannedClaim> planned = plan_claims(claims, o.out);
  SweepEnd end;
  if (const std::vector<SweepRun*> runs = unfinished_runs(planned); !runs.empty()) {
    Progress progress(streams.err, progress_style(streams.err, o.quiet));
    SweepRunner runner(runs, o.jobs.value_or(cores()), interrupts, progress, {[](const SweepRun&) {}, [] {}});
    end = runner.execute("claims");
  }
  if (end.interrupted) return Interrupts::exit_code();
  std::vector<ClaimOutcome> outcomes;
  for (PlannedClaim& each : planned) {
    for (SweepRun& run : each.plan.runs)
      if (run.state != SweepRunState::broken) run.read_folder();  // another claim may have run it
    outcomes.push_back(outcome_of(each));
  }
  if (o.json)
    print_json(claims, outcomes, streams.out);
  else
    streams.out << table_of_outcomes(outcomes, text_columns(streams.out));
  o.publish(claims_report(outcomes), streams.err);
  if (end.code != exit_fine) return end.code;
  return std::ranges::all_of(outcomes, &ClaimOutcome::agrees) ? exit_fine : exit_different;
}

int claims(const ClaimsArguments& o, Streams streams) {
  if (!o.junit.empty() && !o.runs()) throw UsageError("--junit needs --run, --quick or --all");
  const std::vector<Paper> papers = read_papers(o.what);
  const Claims selected = select(papers, o.what);
  if (o.markdown) {
    streams.out << claims_markdown(papers);
    return exit_fine;
  }
  if (o.runs()) return run_claims(o, claims_to_run(o, selected), streams);
  if (o.json)
    print_json(selected, {}, streams.out);
  else if (selected.size() == 1)
    streams.out << claim_text(*selected.front(), text_columns(streams.out).value_or(100));
  else
    streams.out << list_of_claims(selected, text_columns(streams.out));
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_claims(Options& command) {
  auto options = std::make_shared<ClaimsArguments>();
  command.add_argument(
      "PAPER|CLAIM", options->what,
      "key of a paper, name of a claim as PAPER.KEY, or path of a claim file (.toml); default: all papers");
  const Option run =
      command.add("--run", "CLAIM ...", options->run, "run these claims; after PAPER, keys suffice");
  const Option quick =
      command.add_flag("--quick", options->quick, "run the claims that take seconds").excludes(run);
  command.add_flag("--all", options->all, "run all claims").excludes(run).excludes(quick);
  command.add("--out", "DIR", options->out, "folder for the runs; default: out/claims");
  command.add("--jobs", "N", options->jobs, "number of runs at a time; default: all cores")
      .check(positive_whole_number);
  command.add_flag("--markdown", options->markdown, "print tables of all claims in Markdown; run nothing")
      .excludes(run);
  command.add_flag("--quiet", options->quiet, "show no progress");
  options->declare_json(command);
  options->declare_junit(command);
  return [options](Streams streams) { return claims(*options, streams); };
}

}  // namespace taut::cli
