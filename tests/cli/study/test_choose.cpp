#include <map>

#include <doctest/doctest.h>

#include "cli/study/choose.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string runs =
    "finished,tl,tl,0.4,10,stable,,0.005,2,1,\n"  // accurate by chance: the finer run is worse
    "finished,tl,tl,0.2,20,stable,,0.05,2,8,\n"
    "finished,tl,tl,0.1,40,stable,,0.009,2,64,\n"
    "finished,icb,icb,0.4,10,stable,,0.008,2,30,\n"
    "finished,icb,icb,0.2,20,stable,,0.004,2,90,\n"
    "finished,og,og,0.2,20,fractured,0.1,0.001,2,2,\n";

taut::cli::Chart chart_of(const TemporaryFolder& folder) {
  return taut::cli::make_chart(
      taut::cli::read_results({write_results(folder / "a", runs, "colliding-rings")}), {});
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the cheapest run that is stable, accurate and not contradicted by a finer run is chosen") {
    const TemporaryFolder folder;
    const taut::cli::Chart chart = chart_of(folder);
    const auto all = taut::cli::suitable_offers(chart, {0.01, std::nullopt});
    REQUIRE(all.size() == 2);
    CHECK(all[0].series->name == "icb");
    CHECK(all[0].point->spacing == 0.4);
    CHECK(all[0].finer == 1);
    CHECK(all[1].series->name == "tl");
    CHECK(all[1].point->spacing == 0.1);
    CHECK(all[1].finer == 0);
    const auto rough = taut::cli::suitable_offers(chart, {0.06, std::nullopt});
    CHECK(rough.front().point->cost == 1);
    CHECK(rough.front().finer == 2);
    CHECK(taut::cli::suitable_offers(chart, {0.06, 0.5}).empty());
    CHECK(taut::cli::suitable_offers(chart, {0.003, std::nullopt}).empty());
    CHECK(taut::cli::suitable_offers(chart, {0.008, std::nullopt}).front().point->error == 0.008);
    CHECK(taut::cli::suitable_offers(chart, {0.0079, std::nullopt}).front().point->error == 0.004);
    CHECK(taut::cli::suitable_offers(chart, {0.0039, std::nullopt}).empty());
    CHECK(taut::cli::suitable_offers(chart, {0.06, 1.0}).size() == 1);
    CHECK(taut::cli::suitable_offers(chart, {0.06, 0.99}).empty());
  }

  TEST_CASE("a run of unknown cost neither replaces a run of known cost nor counts as cheapest") {
    const TemporaryFolder folder;
    const taut::cli::Chart chart = taut::cli::make_chart(
        taut::cli::read_results({write_results(folder / "a",
                                               "finished,tl,tl,0.4,10,stable,,0.005,2,8,\n"
                                               "finished,tl,tl,0.4,10,stable,,0.005,2,,\n"
                                               "finished,icb,icb,0.4,10,stable,,0.004,2,,\n",
                                               "rod")}),
        {});
    const auto all = taut::cli::suitable_offers(chart, {0.01, std::nullopt});
    REQUIRE(all.size() == 2);
    CHECK(all[0].series->name == "tl");
    CHECK(all[0].point->cost == 8);
    CHECK(all[1].series->name == "icb");
    CHECK(taut::cli::suitable_offers(chart, {0.01, 100.0}).size() == 1);
    CHECK(taut::cli::to_json(all).items().at(1).find("seconds")->is_null());
  }

  TEST_CASE("choose reports method, spacing and evidence, or that no result is accurate enough") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", runs, "colliding-rings");
    const auto choose = [&](Texts more) {
      more.insert(more.begin(), {"choose", "colliding-rings", "--from", file, "--error"});
      return call(more);
    };
    const Outcome found = choose({"1%"});
    CAPTURE(found.err);
    CHECK(found.code == 0);
    CHECK(contains(found.out, "take  icb at a spacing of 0.4 m: error 0.8 %, 30 s\n"));
    CHECK(contains(found.out, "Finer runs that confirm this error: 1."));
    CHECK(contains(found.out, "  tl      0.1"));
    CHECK(contains(choose({"0.01", "--seconds", "40"}).out, "take  icb at a spacing of 0.4"));
    CHECK(contains(choose({"2"}).err, "--error 2 allows an error of 200 %; write 2% for 2 %"));
    CHECK(choose({"0.5"}).err.empty());
    const Outcome far = choose({"0.1%"});
    CHECK(far.code == 1);
    CHECK(contains(far.out, "No run is accurate enough"));
    CHECK(contains(far.out, "icb at a spacing of 0.2 m"));
    CHECK(contains(far.out, "\nSweep other spacings or other methods.\n"));
  }

  TEST_CASE("choose says whether accuracy, time, stability or a finer run is the reason for no choice") {
    const TemporaryFolder folder;
    const auto choose = [&](const std::string& rows, Texts more) {
      const std::string file = write_results(folder / "a", rows, "colliding-rings");
      more.insert(more.begin(), {"choose", "colliding-rings", "--from", file});
      const Outcome outcome = call(more);
      CHECK(outcome.code == 1);
      return outcome.out;
    };
    const std::string accurate = "accurate enough", allow = "\nAllow more time, or sweep other methods.\n",
                      longer =
                          "\nThe cheapest run that is accurate enough takes longer: "
                          "icb at a spacing of 0.4 m, error 0.8 %, 30 s.",
                      none = "There is no stable run with a measured error";
    const std::string contradicted = choose(runs, {"--error", "1%", "--seconds", "5"});
    CHECK(contains(contradicted, "Finer runs of the same method do not confirm this error.\n"));
    CHECK_FALSE(contains(contradicted, "No run"));
    CHECK(contains(contradicted, longer));
    const std::string slow = choose(runs, {"--error", "1%", "--seconds", "0.5"});
    CHECK(contains(slow, none + " in this time.\n"));
    CHECK(contains(slow, allow));
    CHECK_FALSE(contains(slow, "No run"));
    const std::string inaccurate =
        choose("finished,tl,tl,0.2,20,stable,,0.05,2,8,\n" + runs.substr(runs.find("finished,icb")),
               {"--error", "1%", "--seconds", "9"});
    CHECK(contains(inaccurate,
                   "No run in this time is accurate enough. "
                   "The smallest error of a stable run in this time: "
                   "tl at a spacing of 0.2 m, error 5 %, 8 s.\n"));
    CHECK(contains(inaccurate, longer));
    const std::string torn = "finished,og,og,0.2,20,fractured,0.1,0.001,2,2,\n";
    for (const Texts& limits : {Texts{}, {"--seconds", "9"}, {"--error", "1%"}}) {
      const std::string unstable = choose(torn, limits);
      CHECK(contains(unstable, none + ".\n"));
      CHECK_FALSE(contains(unstable, accurate));
      CHECK_FALSE(contains(unstable, allow));
    }
    CHECK(contains(choose(torn + "finished,og,og,0.4,20,stable,,0.001,2,2,\n", {}),
                   "Each stable run has a finer run of its method that is unstable or has no error.\n"));
  }

  TEST_CASE(
      "without --error choose lists the cost of each accuracy, and --error with a listed accuracy returns its run") {
    const TemporaryFolder folder;
    const taut::cli::Chart chart = chart_of(folder);
    const auto all = taut::cli::pareto_front(chart, std::nullopt);
    // tl's first run counts with the error of its finer run, 5 %; icb's first run dominates tl's third
    REQUIRE(all.size() == 3);
    CHECK(all[0].series->name == "tl");
    CHECK(all[0].point->spacing == 0.4);
    CHECK(all[0].error == 0.05);
    CHECK(all[0].finer == 2);
    CHECK(all[1].series->name == "icb");
    CHECK(all[1].error == 0.008);
    CHECK(all[2].error == 0.004);
    for (const auto& offer : all)
      CHECK(taut::cli::suitable_offers(chart, {offer.error, std::nullopt}).front().point == offer.point);
    CHECK(taut::cli::pareto_front(chart, 10).size() == 1);
    const std::string file = write_results(folder / "b", runs, "colliding-rings");
    const Outcome outcome = call({"choose", "colliding-rings", "--from", file});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "  5 %          1   tl      0.4              2\n"));
    const Outcome none = call({"choose", "colliding-rings", "--from", file, "--seconds", "0.5"});
    CHECK(none.code == 1);
    CHECK(contains(none.out, "There is no stable run with a measured error in this time."));
  }

  TEST_CASE("choose omits runs whose parameters differ from the scene's, or from --set") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a",
                                           "finished,tl,tl,0.2,20,stable,,0.001,2,1,0.02\n"
                                           "finished,icb,icb,0.2,20,stable,,0.004,2,90,0.06\n",
                                           "colliding-rings", "v0");
    const Outcome own = call({"choose", "colliding-rings", "--error", "1%", "--from", file});
    CHECK(own.code == 0);
    CHECK(contains(own.out, "icb at a spacing of 0.2 m"));
    CHECK(contains(own.err, "only runs with v0 = 0.06 are used; choose other values with --set"));
    const Outcome slow =
        call({"choose", "colliding-rings", "--set", "v0=0.02", "--error", "1%", "--from", file});
    CHECK(contains(slow.out, "tl at a spacing of 0.2 m"));
    const Outcome none =
        call({"choose", "colliding-rings", "--set", "v0=0.1", "--error", "1%", "--from", file});
    CHECK(none.code == 2);
    CHECK(contains(none.err, "has the values of the scene, v0 = 0.1"));
  }

  TEST_CASE("choose omits runs with another default, `until` or law, or with another value than --set") {
    const TemporaryFolder folder;
    // the wanted run is the dearer one
    const std::string head =
        "status,scene,method,material_law,contact,cfl,parameters.v0,until,particles,steps,spacing,verdict,"
        "seconds.solve,measures.bend.reference,measures.bend.error\n";
    const auto chosen = [&](const std::string& cheap, const Texts& more = {}) {
      std::ofstream(folder / "results.csv")
          << head << "finished,colliding-rings," << cheap << ",9,9,0.001,stable,1,1,0.01\n"
          << "finished,colliding-rings,oenog,neo_hookean,surface,0.6,0.06,0.012,9,9,0.001,stable,5,1,0.01\n";
      Texts words{"choose", "colliding-rings", "--from", folder.str("results.csv"), "--json"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return nlohmann::json::parse(outcome.out)["runs"][0]["method"].get<std::string>();
    };
    const std::string usual = "tl,neo_hookean,surface,0.4,0.06,0.012";
    CHECK(chosen(usual) == "tl");
    CHECK(chosen("tl,,,,,") == "tl");  // unknown
    CHECK(chosen("tl,neo_hookean,surface,0.4,0.05,0.012") == "oenog");
    CHECK(chosen("tl,neo_hookean,surface,0.4,0.06,0.006") == "oenog");
    CHECK(chosen("tl,mooney_rivlin,surface,0.4,0.06,0.012") == "oenog");
    CHECK(chosen("og,2d_deviator,sph,0.5,0.06,0.012") == "og");  // its law cannot be chosen
    CHECK(chosen(usual, {"--set", "cfl=0.6"}) == "oenog");
    CHECK(chosen(usual, {"--set", "cfl=0.4"}) == "tl");
    CHECK(chosen(usual, {"--set", "method=oenog"}) == "oenog");
    CHECK(chosen("tl,neo_hookean,penalty,0.4,0.06,0.012", {"--set", "contact=published"}) == "oenog");
    CHECK(chosen("tl,neo_hookean,penalty,0.4,0.06,0.012", {"--set", "contact=penalty"}) == "tl");
    CHECK(chosen("tl,mooney_rivlin,surface,0.4,0.06,0.012",
                 {"--set", "method=tl", "--set", "law=mooney-rivlin"}) == "tl");
    CHECK(chosen("og,2d_deviator,sph,0.5,0.06,0.012",
                 {"--set", "method=oenog", "--set", "law=neo-hookean"}) == "oenog");
  }

  TEST_CASE("choose compares a parameter that depends on the spacing at the spacing of each run") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    std::string text = text_of(folder / "discs.toml");
    text.replace(text.find("pull = { value = 0"), 18, "pull = { value = \"dp\"");
    std::ofstream(folder / "fine.toml") << text;
    REQUIRE(call({"sweep", folder.str("fine.toml"), "--grid", "method=oenog,tl", "--grid",
                  "spacing=0.002,0.001", "--jobs", "1", "--out", folder.str("sweep"), "--quiet"})
                .code == 0);
    const auto choose = [&](Texts more) {
      more.insert(more.begin(),
                  {"choose", folder.str("fine.toml"), "--from", folder.str("sweep"), "--against", "tl"});
      return call(more);
    };
    CHECK(choose({}).err.empty());
    const Outcome none = choose({"--set", "pull=0.003"});
    CHECK(none.code == 2);
    CHECK(contains(none.err, "has the values of the scene, pull = 0.003"));
  }

  TEST_CASE("choose refuses an invalid error, unknown scenes and measures, and results of another scene") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", runs, "colliding-rings");
    const std::map<Texts, std::string> wrong{
        {{"colliding-rings", "--error", "small", "--from", file}, "it must be a number above 0"},
        {{"colliding-rings", "--error", "-1%", "--from", file}, "it must be a number above 0"},
        {{"ball-plate", "--error", "1%", "--from", file}, "the results are of scene colliding-rings"},
        {{"bal-plate", "--error", "1%", "--from", file}, "did you mean 'ball-plate'"},
        {{"colliding-rings", "--error", "1%", "--measure", "bent", "--from", file}, "did you mean 'bend'"},
    };
    for (const auto& [arguments, message] : wrong) {
      Texts words{"choose"};
      words.insert(words.end(), arguments.begin(), arguments.end());
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
  }

  TEST_CASE("choose compares with the finest run of a method or with a run folder instead of references") {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& out, std::vector<std::string> more) {
      more.emplace_back("--no-render");
      REQUIRE(call(tiny_run(folder, out, more)).code == 0);
    };
    const std::string scene = write_tiny_scene(folder);
    REQUIRE(call({"sweep", scene, "--grid", "method=oenog,tl", "--grid", "spacing=0.002,0.001", "--jobs", "1",
                  "--out", folder.str("sweep"), "--quiet"})
                .code == 0);
    const auto choose = [&](Texts more) {
      more.insert(more.begin(), {"choose", scene, "--from", folder.str("sweep")});
      return call(more);
    };
    CHECK(contains(choose({}).err, "has an error"));
    const auto touch_time = [](const fs::path& of) {
      return json_of(of / "run.json")["measures"]["touch_time"]["value"].get<double>();
    };
    const auto check_errors = [&](const std::string& against, double reference) {
      const Outcome outcome = choose({"--against", against, "--json"});
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      const auto answer = nlohmann::json::parse(outcome.out);
      REQUIRE(answer["runs"].size() > 0);
      for (const auto& offer : answer["runs"]) {
        const double value = touch_time(offer["folder"].get<std::string>());
        CHECK(offer["error"].get<double>() == relative(std::abs(value - reference) / reference));
      }
    };
    check_errors("tl", touch_time(folder / "sweep/method=tl_spacing=0.001"));
    run("fine", {"--spacing", "0.0005", "--method", "tl"});
    check_errors(folder.str("fine"), touch_time(folder / "fine"));
    run("fast", {"--set", "speed=3", "--method", "tl"});
    CHECK(contains(choose({"--against", folder.str("fast")}).err, "has speed = 3, not 2"));
    run("short", {"--until", "0.0015", "--method", "tl"});
    CHECK(contains(choose({"--against", folder.str("short")}).err, "has until = 0.0015, not 0.002"));
    run("other", {"--set", "law=linear", "--method", "tl"});
    CHECK(contains(choose({"--against", folder.str("other")}).err, "has law = linear, not neo-hookean"));
    run("shaken", {"--set", "jitter=0.1", "--method", "tl"});
    CHECK(contains(choose({"--against", folder.str("shaken")}).err, "has jitter = 0.1, not 0"));
    for (const char* other : {"speed=3", "until=0.001", "cfl=0.01"}) {
      CAPTURE(other);
      const Outcome none = choose({"--against", folder.str("fine"), "--set", other});
      CHECK(none.code == 2);
    }
    const Outcome coarse = choose({"--against", folder.str("fine"), "--set", "spacing=0.002", "--json"});
    REQUIRE(coarse.code == 0);
    for (const auto& offer : nlohmann::json::parse(coarse.out)["runs"])
      CHECK(contains(offer["folder"].get<std::string>(), "spacing=0.002"));
    CHECK(choose({"--against", folder.str("nothing")}).code == 2);
  }

  TEST_CASE("choose finds the results below out/") {
    const TemporaryFolder folder;
    write_results(folder / "out/rings", runs, "colliding-rings");
    write_results(folder / "out/other", runs, "ball-plate");
    const std::string there = "cd '" + folder.str("") + "' && " TAUT_BINARY_DIR "/taut choose ";
    REQUIRE(std::system((there + "colliding-rings --error 1% >" + folder.str("text")).c_str()) == 0);
    CHECK(contains(text_of(folder / "text"), "Results: out/rings/results.csv\n"));
    const int status = std::system((there + "elastic-rings --error 1% 2>" + folder.str("text")).c_str());
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(contains(text_of(folder / "text"),
                   "no results of elastic-rings within three levels of folders below out/"));
  }
}
