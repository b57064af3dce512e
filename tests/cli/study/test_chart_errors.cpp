#include <doctest/doctest.h>

#include "cli/study/chart.hpp"
#include "cli/study/stored_results.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

// the last run has the reference 0, so its error is in mm
const std::string mixed =
    "finished,tl,tl,0.4,10,stable,,0.3,2,4,5\n"
    "finished,tl,tl,0.2,20,stable,,0.1,2,8,5\n"
    "finished,tl,tl,0.4,10,stable,,0.02,0,4,0\n";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a chart shows no absolute errors among relative ones, and gives the reason") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", mixed, "rod", "speed");
    const Chart chart = make_chart(read_results({file}), {});
    CHECK(chart.relative);
    CHECK(chart.unit.empty());
    REQUIRE(chart.series.size() == 2);
    CHECK(chart.series[0].points[0].error == 0.3);
    CHECK(chart.series[1].name == "tl, speed=0");
    CHECK_FALSE(chart.series[1].points[0].error.has_value());
    CHECK(without_error(chart.series[1].points[0]) == "no relative error: the reference is 0");
    const Outcome outcome = call({"chart", file, "--markdown"});
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.out, "| 30 % | 10 % |"));
    CHECK(contains(outcome.out, "have no error: tl, speed=0 (no relative error: the reference is 0)"));
    const std::string zero =
        write_results(folder / "b", mixed.substr(mixed.rfind("finished")), "rod", "speed");
    const Chart absolute = make_chart(read_results({zero}), {});
    CHECK(absolute.unit == "mm");
    CHECK(absolute.series[0].points[0].error == 0.02);
  }

  TEST_CASE("the kind of errors is that of the charted methods") {
    const TemporaryFolder folder;
    const StoredResults results =
        read_results({write_results(folder.path(), mixed + "finished,og,og,0.4,10,stable,,0.05,0,4,0\n")});
    CHECK(make_chart(results, {.measure = "", .methods = {"og"}}).series[0].points[0].error == 0.05);
  }

  TEST_CASE("a column of relative errors has no number for a run with the reference 0") {
    const TemporaryFolder folder;
    const StoredResults results = read_results({write_results(folder / "a", mixed, "rod", "speed")});
    const ResultColumn column = find_result_column(results, "bend.error");
    CHECK(column.unit == "%");
    CHECK(column.number(results.runs[0]).value() == Approx(30));
    CHECK_FALSE(column.number(results.runs[2]).has_value());
    const StoredResults zero =
        read_results({write_results(folder / "b", mixed.substr(mixed.rfind("finished")), "rod", "speed")});
    CHECK(find_result_column(zero, "bend.error").unit == "mm");
    CHECK(find_result_column(zero, "bend.error").number(zero.runs[0]) == 0.02);
  }

  TEST_CASE("the refusal of a chart says that all runs diverged") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder.path(),
                                           "failed,tl,tl,0.4,10,diverged,,,2,4,\n"
                                           "failed,og,og,0.4,10,diverged,,,2,4,\n");
    const auto refusal = [&](const Texts& more) {
      Texts words{"chart", file, "--markdown"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = call(words);
      CHECK(outcome.code == 2);
      return outcome.err;
    };
    for (const Texts& more : {Texts{}, Texts{"--measure", "bend"}})
      CHECK(contains(refusal(more), "no measure in the results of rod has an error: all runs diverged\n"));
  }
}
