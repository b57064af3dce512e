#include "cli/claims/claim_tables.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/core.h>

#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"

namespace taut::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::array all_states{ClaimState::holds, ClaimState::in_part, ClaimState::does_not_hold};

std::string counts(const std::vector<const Claim*>& claims) {
  std::string text = fmt::format("{} claim{}", claims.size(), claims.size() == 1 ? "" : "s");
  for (const ClaimState state : all_states)
    text += fmt::format("{} {} {}", state == all_states.front() ? ":" : ",",
                        std::ranges::count(claims, state, &Claim::state),
                        state == ClaimState::holds     ? "hold"
                        : state == ClaimState::in_part ? "in part"
                                                       : "do not hold");
  return text + "\n";
}

std::string shown_values(const ClaimOutcome& outcome) {
  std::string text;
  for (const auto& [quantity, value] : outcome.values)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", quantity, value);
  return text;
}

std::string found(const ClaimOutcome& outcome) {
  if (!outcome.state) return "no result: " + outcome.problem;
  return std::string(name(*outcome.state)) +
         (outcome.evidence ? "" : ", but its evidence condition is false");
}

std::string quoted(const std::string& text) {
  return text.find_first_of(" *()<>&|\"$") == std::string::npos ? text : fmt::format("'{}'", text);
}

/// Scene name for `taut run`, else the path.
std::string name_or_path(const std::string& scene) {
  const std::vector<std::string> names = scene_names();
  const std::string stem = std::filesystem::path(scene).stem().string();
  std::error_code error;
  const bool named = std::ranges::find(names, stem) != names.end() &&
                     std::filesystem::equivalent(find_scene(stem), scene, error);
  return named ? stem : scene;
}

Rows counts_by_paper(const std::vector<Paper>& papers) {
  Rows rows{{"paper", "claims", "hold", "in part", "do not hold"}};
  std::array<long, 4> sums{};
  const auto add = [&](const std::string& title, const std::array<long, 4>& numbers) {
    rows.push_back({title});
    for (const long number : numbers) rows.back().push_back(std::to_string(number));
  };
  for (const Paper& paper : papers) {
    std::array<long, 4> numbers{static_cast<long>(paper.claims.size())};
    for (std::size_t s = 0; s < all_states.size(); ++s)
      numbers[s + 1] = std::ranges::count(paper.claims, all_states[s], &Claim::state);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += numbers[k];
    add(paper.key, numbers);
  }
  add("all", sums);
  return rows;
}

Rows failures(const Paper& paper) {
  Rows rows{{"claim", "statement", "state", "reason"}};
  for (const Claim& claim : paper.claims)
    if (claim.state != ClaimState::holds)
      rows.push_back({fmt::format("`{}`, {}", claim.key, claim.place), claim.text,
                      std::string(name(claim.state)), claim.reason});
  return rows;
}

Rows all_claims(const Paper& paper) {
  Rows rows{{"claim", "statement", "published", "state", "weaker than the paper in", "last run"}};
  for (const Claim& claim : paper.claims)
    rows.push_back({fmt::format("`{}`, {}", claim.key, claim.place), claim.text, claim.published,
                    std::string(name(claim.state)), claim.looser, claim.last_run});
  return rows;
}

}  // namespace

std::string list_of_claims(const std::vector<const Claim*>& claims, std::optional<std::size_t> columns) {
  Rows rows{{"claim", "place", "state", "cost", "statement"}};
  for (const Claim* claim : claims)
    rows.push_back({claim->name(), claim->place, std::string(name(claim->state)),
                    claim->quick ? "quick" : "slow", claim->text});
  return fmt::format("{}\n{}", in_columns(rows, 0, columns), counts(claims));
}

std::string command_of(const Claim& claim, const ClaimRun& run) {
  std::string command = "taut run " + quoted(name_or_path(claim.scene));
  for (const Setting& s : run.settings) {
    const bool own_option = s.name == "method" || s.name == "spacing" || s.name == "until";
    command += own_option ? fmt::format(" --{} {}", s.name, quoted(s.value)) : " --set " + quoted(text_of(s));
  }
  return command;
}

std::string claim_text(const Claim& claim, std::size_t columns) {
  std::string text = fmt::format("{}, {}: {}\n", claim.name(), claim.place, name(claim.state));
  const auto add = [&](const std::string& title, const std::string& content) {
    if (!content.empty()) text += wrapped(fmt::format("{}: {}", title, content), 2, columns) + "\n";
  };
  add("statement", claim.text);
  add("published", claim.published);
  for (const ClaimRun& run : claim.runs) add("run " + run.name, command_of(claim, run));
  add("criterion", claim.criterion);
  add("weaker than the paper in", claim.looser);
  add("in part", claim.part);
  add("reason", claim.reason);
  add("evidence", claim.evidence);
  add("last run", claim.last_run);
  return text;
}

std::string table_of_outcomes(const std::vector<ClaimOutcome>& outcomes, std::optional<std::size_t> columns) {
  Rows rows{{"claim", "recorded", "here", "", "values"}};
  for (const ClaimOutcome& outcome : outcomes)
    rows.push_back({outcome.claim->name(), std::string(name(outcome.claim->state)), found(outcome),
                    outcome.agrees() ? "agrees" : "DIFFERS", shown_values(outcome)});
  const auto differ = std::ranges::count(outcomes, false, &ClaimOutcome::agrees);
  return fmt::format("{}\n{}\n", in_columns(rows, 0, columns),
                     differ == 0 ? fmt::format("all {} agree", outcomes.size())
                                 : fmt::format("{} of {} differ", differ, outcomes.size()));
}

std::string claims_markdown(const std::vector<Paper>& papers) {
  std::string page = markdown_table(counts_by_paper(papers));
  for (const Paper& paper : papers) {
    page += fmt::format("\n## {}\n\n{}.\n", paper.key, paper.title);
    if (const Rows rows = failures(paper); rows.size() > 1)
      page += "\nClaims that do not hold, or hold in part:\n\n" + markdown_table(rows);
    page += "\nAll claims:\n\n" + markdown_table(all_claims(paper));
  }
  return page;
}

Json claim_json(const Claim& claim, const ClaimOutcome* outcome) {
  Json runs = Json::object();
  for (const ClaimRun& run : claim.runs) runs[run.name] = command_of(claim, run);
  Json json = {{"name", claim.name()},
               {"place", claim.place},
               {"text", claim.text},
               {"published", claim.published},
               {"cost", claim.quick ? "quick" : "slow"},
               {"runs", std::move(runs)},
               {"criterion", claim.criterion},
               {"part", claim.part},
               {"looser", claim.looser},
               {"state", name(claim.state)},
               {"reason", claim.reason},
               {"evidence", claim.evidence},
               {"last_run", claim.last_run}};
  if (!outcome) return json;
  Json values = Json::object();
  for (const auto& [quantity, value] : outcome->values) values[quantity] = value;
  json["here"] = {{"state", outcome->state ? Json(name(*outcome->state)) : Json()},
                  {"evidence", outcome->evidence},
                  {"agrees", outcome->agrees()},
                  {"problem", outcome->problem},
                  {"values", std::move(values)}};
  return json;
}

TestReport claims_report(const std::vector<ClaimOutcome>& outcomes) {
  using Result = TestCase::Result;
  TestReport report{"claims", "papers", {}};
  for (const ClaimOutcome& outcome : outcomes) {
    const Result result = outcome.agrees() ? Result::passed : outcome.state ? Result::failed : Result::error;
    const std::string values = outcome.values.empty() ? "" : fmt::format(" ({})", shown_values(outcome));
    report.cases.push_back(
        {outcome.claim->name(), result,
         fmt::format("{}: recorded state '{}', state found here: {}{}", outcome.claim->name(),
                     name(outcome.claim->state), found(outcome), values)});
  }
  return report;
}

}  // namespace taut::cli
