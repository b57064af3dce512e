#include <fstream>

#include <doctest/doctest.h>

#include "cli/claims/claim_tables.hpp"
#include "cli/claims/criterion.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

/// `lines`: remaining lines of the claim.
std::string claim_file(const TemporaryFolder& folder, const std::string& lines) {
  write_tiny_scene(folder);
  std::ofstream(folder / "Nobody1999.toml") << R"(title = "Nobody"
[[claim]]
key = "fig-1"
place = "Fig. 1"
text = "Faster discs carry more energy."
scene = "discs.toml"
last_run = "2000-01-01"
)" + lines;
  return (folder / "Nobody1999.toml").string();
}

const std::string two_runs = "run.slow = { until = 0.0002 }\nrun.fast = { until = 0.0002, speed = 4 }\n";

Outcome run_claim(const TemporaryFolder& folder, const std::string& lines) {
  return call({"claims", claim_file(folder, lines), "--all", "--quiet", "--jobs", "1", "--out",
               (folder / "out").string()});
}

std::string refusal(const std::string& lines) {
  const TemporaryFolder folder;
  return call({"claims", claim_file(folder, lines)}).err;
}

const std::string more_energy = "fast.first.kinetic_energy > 3.9*slow.first.kinetic_energy";
const std::string less_energy = "fast.first.kinetic_energy < slow.first.kinetic_energy";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("claims: a claim agrees if its runs give the recorded state and its evidence holds") {
    const TemporaryFolder folder;
    const auto state = [&](const std::string& lines) { return run_claim(folder, two_runs + lines); };
    const Outcome holds = state("criterion = '" + more_energy + "'");
    CHECK(holds.code == 0);
    CHECK(contains(holds.out, "all 1 agree"));
    const Outcome fails = state("criterion = '" + less_energy + "'");
    CHECK(fails.code == 1);
    CHECK(contains(fails.out, "does not hold"));
    CHECK(contains(fails.out, "1 of 1 differ"));
    const std::string with_reason = "reason = 'none'\nstate = ";
    CHECK(state("criterion = '" + less_energy + "'\n" + with_reason + "'does not hold'").code == 0);
    CHECK(state("criterion = '" + more_energy + "'\n" + with_reason + "'does not hold'").code == 1);
    const std::string part = "criterion = '" + less_energy + "'\npart = '" + more_energy + "'\n";
    CHECK(state(part + with_reason + "'in part'").code == 0);
    CHECK(state(part + with_reason + "'does not hold'").code == 1);
    const std::string weak = part + with_reason + "'in part'\nevidence = '" + less_energy + "'";
    const Outcome without_evidence = state(weak);
    CHECK(without_evidence.code == 1);
    CHECK(contains(without_evidence.out, "but its evidence condition is false"));
  }

  TEST_CASE("claims: an unknown measure gives no result, which disagrees with the state 'does not hold'") {
    const TemporaryFolder folder;
    const std::string lines =
        two_runs + "criterion = 'slow.touch_tim > 0'\nreason = 'none'\nstate = 'does not hold'";
    const Outcome wrong = run_claim(folder, lines);
    CHECK(wrong.code == 1);
    CHECK(contains(wrong.out, "no result: slow: unknown measure or number of run.json 'touch_tim'"));
  }

  TEST_CASE("claims: a report ends with the values, or without values with the reason") {
    Claim claim;
    claim.paper = "Nobody1999", claim.key = "fig-1";
    ClaimOutcome outcome{&claim};
    outcome.problem = "slow: the run is not finished";
    const auto text = [&] { return claims_report({outcome}).cases.at(0).text; };
    CHECK(
        text() ==
        "Nobody1999.fig-1: recorded state 'holds', state found here: no result: slow: the run is not finished");
    outcome.values = {{"slow.verdict", "stable"}};
    CHECK(text().ends_with("no result: slow: the run is not finished (slow.verdict stable)"));
  }

  TEST_CASE("claims: text, JSON and Markdown contain the recorded states, and text the commands") {
    const TemporaryFolder folder;
    const std::string file = claim_file(folder, two_runs + "criterion = '" + more_energy + "'");
    const Outcome one = call({"claims", file});
    CHECK(contains(one.out, "Nobody1999.fig-1, Fig. 1: holds"));
    CHECK(contains(one.out, "discs.toml --until 2e-04 --set speed=4"));
    const std::string own = folder.str("colliding-rings.toml");
    fs::rename(folder / "discs.toml", own);
    std::string claim = text_of(file);
    claim.replace(claim.find("discs.toml"), 5, "colliding-rings");
    std::ofstream(file) << claim;
    CHECK(contains(call({"claims", file}).out, "taut run " + own + " --until"));
    fs::remove(own);
    claim.replace(claim.find(".toml"), 5, "");
    claim.replace(claim.find("speed"), 5, "v0");
    std::ofstream(file) << claim;
    CHECK(contains(call({"claims", file}).out, "taut run colliding-rings --until"));
    const auto json = nlohmann::ordered_json::parse(call({"claims", file, "--json"}).out);
    CHECK(json["claims"][0]["name"] == "Nobody1999.fig-1");
    CHECK(json["claims"][0]["state"] == "holds");
    CHECK_FALSE(json["claims"][0].contains("here"));
    CHECK(contains(call({"claims", file, "--markdown"}).out, "| Nobody1999 | 1 | 1 | 0 | 0 |"));
  }

  TEST_CASE("claims: unknown papers and claims are refused with the nearest names") {
    CHECK(contains(call({"claims", "Zhang2025"}).err,
                   "unknown paper 'Zhang2025' (did you mean 'Zhang2020', 'Zhang2024' or 'Zhang2024b'?)"));
    const Outcome wrong = call({"claims", "Zhang2024", "--run", "fig-3x"});
    CHECK(wrong.code == 2);
    CHECK(contains(wrong.err, "unknown claim 'fig-3x'"));
    CHECK(contains(call({"claims", "Zhang2024.fig-3aa"}).err, "did you mean 'Zhang2024.fig-3a'"));
    CHECK(call({"claims", "--junit", "a.xml"}).code == 2);
  }

  TEST_CASE("claims: a mistake in a claim file is refused with the reason") {
    const std::string fine = two_runs + "criterion = '" + more_energy + "'\n";
    CHECK(refusal(fine).empty());
    CHECK(contains(refusal(two_runs + "criterion = 'fst.verdict == stable'"),
                   "Nobody1999.toml:10:13: 'fst.verdict': unknown run 'fst' (did you mean 'fast'?)"));
    CHECK(contains(refusal(two_runs + "criterion = 'fast.verdict == stabl'"), "did you mean 'stable'"));
    CHECK(contains(refusal(two_runs + "criterion = '1 < 2'"), "contains no quantity of a run"));
    CHECK(contains(refusal(two_runs), "criterion"));
    CHECK(contains(refusal(fine + "state = 'hold'"), "'hold'"));
    CHECK(contains(refusal(fine + "state = 'does not hold'"), "needs a reason"));
    CHECK(contains(refusal(fine + "reason = 'none'"), "needs no reason"));
    CHECK(contains(refusal(fine + "state = 'in part'\nreason = 'none'"), "needs the criterion 'part'"));
    CHECK(contains(refusal(fine + "stat = 'holds'"), "stat"));
    CHECK(contains(refusal("criterion = 'a.verdict == stable'"), "run"));
  }

  TEST_CASE("claims: a setting that the scene lacks is refused with its place") {
    const TemporaryFolder folder;
    const Outcome wrong = run_claim(folder, "run.a = { speeed = 1 }\ncriterion = 'a.verdict == stable'");
    CHECK(wrong.code == 2);
    CHECK(contains(wrong.err, "Nobody1999.toml:8:"));
    CHECK(contains(wrong.err, "speeed"));
  }

  TEST_CASE(
      "claims: the quantities of a criterion are found, each once, and their values and verdicts are compared") {
    const auto quantities = quantities_in("a.min.tip > -0.5*a.min.tip && sqrt(b.since.fractured) < 1.5e-3");
    REQUIRE(quantities.size() == 2);
    CHECK(quantities[0].name() == "a.min.tip");
    CHECK(quantities[1].run == "b");
    CHECK(quantities[1].path == "since.fractured");
    CHECK(is_met("a.verdict >= fractured && a.x < -0.5", {{"a.verdict", 4}, {"a.x", -1}}));
    CHECK_FALSE(is_met("a.verdict < fractured", {{"a.verdict", 3}}));
    CHECK(is_met("a__b.c > a.b__c", {{"a__b.c", 2}, {"a.b__c", 1}}));
  }

  TEST_CASE("claims: the extremes of a history column with NaN have no value") {
    const TemporaryFolder folder;
    std::ofstream(folder / "history.csv") << "t,tip\n0,1\n1,nan\n2,3\n";
    CHECK(value_of(folder.str(""), "last.tip").number == 3);
    for (const char* path : {"min.tip", "max.tip"})
      CHECK_THROWS_WITH_AS(value_of(folder.str(""), path), doctest::Contains("tip is not finite"),
                           UsageError);
  }
}
