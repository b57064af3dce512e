#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

void write_table(const TemporaryFolder& folder, const std::string& gap) {
  std::ofstream(folder / "gap.csv") << "t,gap\n0," << gap << "\n0.002,0\n";
}

/// Height in m.
void write_block(const TemporaryFolder& folder, double height) {
  std::ofstream file(folder / "block.csv");
  file << "x,y\n";
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) file << 0.002 * i << ',' << height + 0.002 * j << '\n';
}

/// Writes a scene with a reference table and a body of listed particles. Returns the words of a sweep in `folder`.
Texts sweep_with_files(const TemporaryFolder& folder, const Texts& more) {
  const std::string text = text_of(write_tiny_scene(folder));
  std::ofstream(folder / "files.toml") << text << R"(
[[body]]
name = "block"
shape = { type = "particles", file = "block.csv" }
material = "rubber"
)" << reference_of_gap("gap.csv");
  write_table(folder, "0.002");
  write_block(folder, 0.05);
  Texts words{"sweep", folder.str("files.toml"), "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "a sweep of a scene that names files succeeds in a folder without out/, and has no run to repeat") {
    const TemporaryFolder folder;
    const Texts words =
        sweep_with_files(folder, {"--grid", "speed=1,2", "--out", "out/sweep", "--until", "1e-5"});
    const Outcome first = program(words, folder / "");
    CAPTURE(first.err);
    CHECK(first.code == 0);
    CHECK(statuses(folder / "out/sweep") == Texts{"finished", "finished"});
    const auto before = ends(folder / "out/sweep");
    CHECK(program(words, folder / "").code == 0);
    CHECK(ends(folder / "out/sweep") == before);
  }

  TEST_CASE("a sweep replaces its runs if a reference table or a shape file has changed") {
    const TemporaryFolder folder;
    const Texts words = sweep_with_files(folder, {"--grid", "speed=1,2", "--out", "out", "--until", "1e-5"});
    const auto sweep = [&] {
      Outcome outcome = program(words, folder / "");
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return outcome.err;
    };
    const auto error = [&] {
      return json_of(folder / "out/results.json")["runs"][1]["measures"]["gap_rmse"]["value"].get<double>();
    };
    const std::string message = "2 finished runs in 'out' have other settings, other input files or another";
    sweep();
    const auto first = ends(folder / "out");
    const double first_error = error();
    CHECK_FALSE(contains(sweep(), "finished runs"));
    CHECK(ends(folder / "out") == first);
    write_table(folder, "0.001");
    CHECK(contains(sweep(), message));
    CHECK(ends(folder / "out").at("speed=1") > first.at("speed=1"));
    CHECK(error() != first_error);
    const auto second = ends(folder / "out");
    write_block(folder, 0.06);
    CHECK(contains(sweep(), message));
    CHECK(ends(folder / "out").at("speed=2") > second.at("speed=2"));
  }

  TEST_CASE("a sweep keeps runs of older versions, whose run.json has no checksum of files") {
    const TemporaryFolder folder;
    const Texts words = sweep_with_files(folder, {"--grid", "speed=1,2", "--out", "out", "--until", "1e-5"});
    REQUIRE(program(words, folder / "").code == 0);
    for (const char* name : {"out/speed=1/run.json", "out/speed=2/run.json"}) {
      auto record = json_of(folder / name);
      REQUIRE(record.erase("file_checksum") == 1);
      std::ofstream(folder / name) << record.dump(2);
    }
    const auto before = ends(folder / "out");
    write_table(folder, "0.001");
    REQUIRE(program(words, folder / "").code == 0);
    CHECK(ends(folder / "out") == before);
  }

  TEST_CASE("a run continues only with the same tables and shapes") {
    const TemporaryFolder folder;
    sweep_with_files(folder, {});
    const fs::path record = folder / "run/run.json";
    const auto run = [&](Texts words) {
      words.insert(words.end(), {"--quiet", "--no-render", "--keep-checkpoint"});
      return program(words);
    };
    const Texts start{"run", folder.str("files.toml"), "--out", folder.str("run"), "--until", "1e-5"};
    REQUIRE(run(start).code == 0);
    const auto checksum = json_of(record)["file_checksum"];
    REQUIRE(run({"run", "--resume", folder.str("run"), "--until", "2e-5"}).code == 0);
    CHECK(json_of(record)["file_checksum"] == checksum);
    write_table(folder, "0.001");
    const std::string before = text_of(record);
    const Outcome refused = run({"run", "--resume", folder.str("run"), "--until", "4e-5"});
    CHECK(refused.code == 2);
    CHECK(contains(refused.err, "a table or shape that '" + folder.str("run/scene.toml") +
                                    "' names has changed since the run started"));
    CHECK(text_of(record) == before);
    REQUIRE(run(start).code == 0);
    CHECK(json_of(record)["file_checksum"] != checksum);
  }

  TEST_CASE("a sweep replaces runs whose saved particles have other fields, precision or format") {
    const TemporaryFolder folder;
    const auto sweep = [&](const Texts& more) {
      Texts words{"--grid", "speed=1", "--until", "1e-5"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = program(tiny_sweep(folder, "out", words));
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return ends(folder / "out").at("speed=1");
    };
    const auto saved = [&] { return json_of(folder / "out/speed=1/run.json")["saved_particles"]; };
    const Texts speed{"--save-particles", "--fields", "speed"};
    const Texts both{"--save-particles", "--fields", "speed,pressure"};
    const Texts single{"--save-particles", "--fields", "speed,pressure", "--particle-precision", "single"};
    const Texts xyz{"--save-particles", "xyz", "--fields", "speed,pressure"};
    const auto first = sweep(speed);
    CHECK(saved() ==
          nlohmann::ordered_json{{"format", "vtp"}, {"precision", "double"}, {"fields", {"speed"}}});
    CHECK(sweep(speed) == first);
    CHECK(sweep({}) == first);
    const auto second = sweep(both);
    CHECK(second > first);
    CHECK(saved()["fields"] == Texts{"speed", "pressure"});
    const auto third = sweep(single);
    CHECK(third > second);
    CHECK(saved()["precision"] == "single");
    CHECK(sweep(single) == third);
    CHECK(sweep(xyz) > third);
    CHECK(saved()["format"] == "xyz");
  }
}
