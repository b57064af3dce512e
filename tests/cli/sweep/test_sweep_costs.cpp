#include <doctest/doctest.h>

#include "cli/study/chart.hpp"
#include "cli/study/chart_tables.hpp"
#include "cli/sweep/results.hpp"
#include "cli/system/machine.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

SweepRun run_of_cost(double cpu) {
  SweepRun run;
  run.state = SweepRunState::done;
  run.record.emplace();
  run.record->seconds = {.setup = 0, .solve = 10 * cpu, .render = 0, .write = 0, .cpu = cpu};
  return run;
}

/// The keys of two balls, or of two discs in 2D, whose shape has the keys `size`.
std::string pair_scene(int dim, const std::string& shape, const std::string& size,
                       const std::string& modulus) {
  std::string text =
      "source = 'none'\nspacing = 0.001\nuntil = 2e-4\nmethod = 'enog'\ndim = " + std::to_string(dim) +
      "\n[material.rubber]\ndensity = 1000\npoisson_ratio = 0.4\nyoungs_modulus = " + modulus + "\n";
  for (const std::string side : {"-", ""})
    text += "[[body]]\nname = 'body" + side + "'\nmaterial = 'rubber'\nshape = { type = '" + shape +
            "', centre = [" + side + "0.1, 0" + (dim == 3 ? ", 0" : "") + "], " + size + " }\n";
  return text;
}

std::string costs(const TemporaryFolder& folder, const std::string& rows) {
  std::ofstream(folder / "results.csv")
      << "status,method,scene,particles,steps,spacing,verdict,seconds.solve,seconds.cpu,other_load,"
         "measures.bend.unit,measures.bend.reference,measures.bend.error\n"
      << rows;
  return folder.str("results.csv");
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the cost of a repeated run is the median, with its spread") {
    SweepRun run = run_of_cost(3);
    run.repetitions = {run_of_cost(1), run_of_cost(2), SweepRun{}};
    const auto cost = run.cost();
    REQUIRE(cost);
    CHECK(cost->runs == 3);
    CHECK(cost->median->seconds.cpu == 2);
    CHECK(cost->spread == 1);
    SweepPlan plan;
    plan.runs.push_back(std::move(run));
    const Json tree = results_tree(plan);
    const Json& row = tree.find("runs")->items()[0];
    CHECK(row.find("seconds")->find("cpu")->number() == 2);
    CHECK(row.find("seconds")->find("solve")->number() == 20);
    CHECK(row.find("repeated")->find("runs")->number() == 3);
    CHECK_FALSE(SweepRun{}.cost());
  }

  TEST_CASE("the expected work of a run is proportional to particles times steps, also in other scenes") {
    const TemporaryFolder folder;
    double first = 0;
    for (const std::string& scene :
         {pair_scene(2, "disc", "radius = 0.01", "1e6"), pair_scene(2, "disc", "radius = 0.03", "1e6"),
          pair_scene(2, "ring", "inner = 0.01, outer = 0.012", "1e8"),
          pair_scene(3, "ball", "radius = 0.006", "1e7")}) {
      CAPTURE(scene);
      std::ofstream(folder / "pair.toml") << scene;
      SweepRequest request;
      request.base.scene = folder.str("pair.toml");
      request.base.no_render = true;
      request.base.threads = 1;
      request.rows = {{{"cfl", "0.25"}}};
      request.folder = folder / "plan";
      const double work = plan_sweep(request).runs.at(0).work;
      REQUIRE(call({"run", folder.str("pair.toml"), "--set", "cfl=0.25", "--no-render", "--threads", "1",
                    "--quiet", "--out", folder.str("out")})
                  .code == 0);
      const auto record = json_of(folder / "out/run.json");
      const double ratio = work / (record["particles"].get<double>() * record["steps"].get<double>());
      if (first == 0) first = ratio;
      CHECK(ratio == relative(first, 0.2));
    }
  }

  TEST_CASE("a sweep repeats each run and prints the median cost") {
    const TemporaryFolder folder;
    const Texts words =
        tiny_sweep(folder, "out", {"--grid", "speed=1,2", "--until", "1e-4", "--repeat", "3"});
    const Outcome outcome = program(words);
    REQUIRE(outcome.code == 0);
    CHECK(contains(lines_of(folder / "out/results.csv").front(), "seconds.cpu"));
    CHECK(contains(lines_of(folder / "out/results.csv").front(), ",repeated.runs,repeated.cpu_spread"));
    CHECK(contains(outcome.out, "median CPU, s"));
    for (const char* name : {"speed=1", "repeat-2/speed=1", "repeat-3/speed=2"})
      CHECK(json_of(folder / "out" / name / "run.json")["seconds"]["cpu"].get<double>() > 0);
    const auto row = json_of(folder / "out/results.json")["runs"][1];
    CHECK(row["repeated"]["runs"] == 3);
    fs::remove_all(folder / "out/repeat-2/speed=1");
    const auto before = fs::last_write_time(folder / "out/repeat-3/speed=1/run.json");
    REQUIRE(program(words).code == 0);
    CHECK(fs::exists(folder / "out/repeat-2/speed=1/run.json"));
    CHECK(fs::last_write_time(folder / "out/repeat-3/speed=1/run.json") == before);
    const Outcome plain = program(tiny_sweep(folder, "plain", {"--grid", "speed=1", "--until", "1e-4"}));
    CHECK_FALSE(contains(lines_of(folder / "plain/results.csv").front(), "repeated"));
    CHECK_FALSE(contains(plain.out, "median"));
  }

  TEST_CASE("a failed repetition is an error of its run") {
    SweepRun run = run_of_cost(1);
    run.repetitions = {run_of_cost(2)};
    CHECK(test_case(run, {}).result == TestCase::Result::passed);
    SweepRun& interrupted = run.repetitions.emplace_back();
    interrupted.state = SweepRunState::interrupted;
    CHECK(test_case(run, {}).result == TestCase::Result::error);
    CHECK(test_case(run, {}).text == "to do");
    interrupted.state = SweepRunState::broken, interrupted.problem = "killed: Aborted";
    CHECK(test_case(run, {}).result == TestCase::Result::error);
    CHECK(test_case(run, {}).text == "killed: Aborted");
  }

  TEST_CASE("a sweep with a failed repetition has not passed, and reports the message of the repetition") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out/repeat-2/speed=1");
    std::ofstream(folder / "out/sweep.lock") << "";
    // a lock file cannot be opened through a symlink, so this run cannot write
    fs::create_symlink("nowhere", folder / "out/repeat-2/speed=1/run.lock");
    const Outcome outcome = program(tiny_sweep(folder, "out",
                                               {"--grid", "speed=1,2", "--until", "1e-5", "--repeat", "2",
                                                "--json", "--junit", folder.str("junit.xml")}));
    CHECK(outcome.code == 4);
    const auto answer = nlohmann::ordered_json::parse(outcome.out);
    CHECK(answer["passed"] == false);
    CHECK(answer["runs"][0]["status"] == "finished");
    CHECK(contains(answer["runs"][0]["message"].get<std::string>(), "run.lock"));
    CHECK(answer["runs"][1]["message"].is_null());
    CHECK(contains(text_of(folder / "junit.xml"), "errors=\"1\""));
  }

  TEST_CASE("a sweep that measures costs refuses more jobs than physical cores") {
    const TemporaryFolder folder;
    const std::string jobs = std::to_string(physical_cores() + 1);
    const Texts grid{"--grid", "speed=1,2", "--until", "1e-5", "--jobs", jobs};
    Texts repeated = grid;
    repeated.insert(repeated.end(), {"--repeat", "2"});
    const Outcome outcome = program(tiny_sweep(folder, "out", repeated));
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--jobs is " + jobs +
                                    "; a sweep with repetitions measures costs, so at most " +
                                    std::to_string(physical_cores())));
    CHECK(program(tiny_sweep(folder, "out", grid)).code == 0);
    CHECK(program(tiny_sweep(folder, "out", {"--grid", "speed=1", "--repeat", "101"})).code == 2);
  }

  TEST_CASE("a chart shows CPU seconds, or wall seconds if a run has no CPU seconds") {
    const TemporaryFolder folder;
    const std::string run = "finished,tl,rod,9,9,0.2,stable,7,3,,m,2,0.1\n";
    const Chart cpu = make_chart(read_results({costs(folder, run)}), {});
    CHECK(cpu.cost == Cost::cpu);
    CHECK(cpu.series[0].points[0].cost == 3);
    CHECK(make_chart(read_results({costs(folder, run)}), {"", Cost::wall}).series[0].points[0].cost == 7);
    const std::string older = "finished,tl,rod,9,9,0.1,stable,8,,,m,2,0.1\n";
    const std::string file = costs(folder, run + older);
    const Chart mixed = make_chart(read_results({file}), {});
    CHECK(mixed.cost == Cost::wall);
    CHECK(mixed.series[0].points[1].cost == 8);
    const Outcome outcome = call({"chart", file, "--markdown"});
    CHECK(contains(outcome.err, "some runs were stored without CPU seconds, so the cost is the wall time"));
    CHECK_FALSE(contains(call({"chart", file, "--markdown", "--cost", "seconds"}).err, "CPU"));
  }

  TEST_CASE("a chart notes that the machine was busy") {
    const TemporaryFolder folder;
    const auto notes = [&](const std::string& load) {
      const std::string row = "finished,tl,rod,9,9,0.2,stable,7,3," + load + ",m,2,0.1\n";
      return footnotes(make_chart(read_results({costs(folder, row)}), {})).back();
    };
    CHECK(contains(notes("1.25"), "the machine was busy: others used up to 1.25 cores"));
    CHECK_FALSE(contains(notes("0.1"), "busy"));
    CHECK_FALSE(contains(notes(""), "busy"));
  }
}
