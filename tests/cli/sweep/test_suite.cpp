#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string entries_of_discs = R"([[entry]]
name = "discs"
scene = "discs.toml"

[[entry]]
name = "discs-og"
scene = "discs.toml"
method = "og"
render = { color = "pressure" }

[[entry]]
name = "faster"
differs_from = "discs"
set = { speed = 4 }
)";
const std::string short_runs = "set = { until = 0.001 }\nrender = { frames = 2 }\n";

std::string replaced_once(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

long lines_about(const std::string& text, const std::string& beginning, const std::string& part) {
  std::istringstream stream(text);
  long count = 0;
  for (std::string line; std::getline(stream, line);)
    count += line.starts_with(beginning) && contains(line, part);
  return count;
}

std::string write_suite(const TemporaryFolder& folder, const std::string& text) {
  write_tiny_scene(folder);
  std::ofstream(folder / "suite.toml") << text;
  return folder.str("suite.toml");
}

Outcome run_suite(const TemporaryFolder& folder, const std::string& text, const Texts& more = {}) {
  Texts words{"snapshot", write_suite(folder, text), "--out", folder.str("out"), "--jobs", "1", "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  return program(words);
}

std::string refusal_of_suite(const std::string& text, const Texts& more = {}) {
  const TemporaryFolder folder;
  const Outcome outcome = run_suite(folder, text, more);
  CHECK(outcome.code == 2);
  CHECK_FALSE(fs::exists(folder / "out"));
  return outcome.err;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("suite: entries are compared with their baselines, and every frame that differs is listed") {
    const TemporaryFolder folder;
    const Outcome updated = run_suite(folder, short_runs + entries_of_discs, {"--update"});
    CAPTURE(updated.err);
    REQUIRE(updated.code == 0);
    CHECK(files_in(folder / "suite/discs") == 4);
    CHECK(files_in(folder / "suite/discs-og") == 4);
    CHECK_FALSE(fs::exists(folder / "suite/faster"));
    const Outcome alike = run_suite(folder, short_runs + entries_of_discs);
    CHECK(alike.code == 0);
    CHECK(contains(alike.out, "differs, as a control must"));
    CHECK(contains(alike.out, "all of 3 entries passed"));
    CHECK_FALSE(contains(alike.out, "frame_00000.png  different"));
    const std::string faster = replaced_once(short_runs, "until = 0.001", "until = 0.001, speed = 2.5");
    const Outcome other = run_suite(folder, faster + entries_of_discs);
    CHECK(other.code == 1);
    CHECK(lines_about(other.out, "discs ", "different") == 1 + 3);  // entry and frames
    CHECK(contains(other.out, "of 3 entries failed"));
  }

  TEST_CASE("suite: a control whose frames are like the baseline fails") {
    const TemporaryFolder folder;
    const std::string same = replaced_once(short_runs + entries_of_discs, "speed = 4", "speed = 2");
    REQUIRE(run_suite(folder, same, {"--update"}).code == 0);
    const Outcome outcome = run_suite(folder, same, {"--only", "faster"});
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.out, "alike, but a control must differ"));
  }

  TEST_CASE("suite: differences between the limits warn, and a difference beyond `fail` fails") {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& limits, const std::string& speed, const Texts& more = {}) {
      return run_suite(folder,
                       "set = { until = 1e-4, speed = " + speed + " }\nrender = { frames = 1 }\n" + limits +
                           "[[entry]]\nname = 'discs'\nscene = 'discs.toml'\n",
                       more);
    };
    REQUIRE(with("", "2", {"--update"}).code == 0);
    const Outcome unnoticed = with("", "2.02");
    CHECK(unnoticed.code == 0);
    CHECK_FALSE(contains(unnoticed.out, "warning"));
    const Outcome warned = with("warn = 0.05\n", "2.02");
    CHECK(warned.code == 0);
    CHECK(contains(warned.out, "alike, with a warning"));
    CHECK(contains(warned.out, "frame_00000.png  warning"));
    CHECK(with("fail = 0.05\n", "2.02").code == 1);
    CHECK(with("warn = 0.01\nfail = 60\n", "2.02").code == 0);
  }

  TEST_CASE(
      "suite: --update --only renews no other baseline, and an unknown name is refused with the nearest name") {
    const TemporaryFolder folder;
    REQUIRE(run_suite(folder, short_runs + entries_of_discs, {"--update"}).code == 0);
    const auto frame = [&](const char* entry) {
      return text_of(folder / "suite" / entry / "frame_00001.png");
    };
    const std::string discs = frame("discs"), og = frame("discs-og");
    const std::string faster = replaced_once(short_runs, "until = 0.001", "until = 0.001, speed = 2.5");
    REQUIRE(run_suite(folder, faster + entries_of_discs, {"--update", "--only", "discs-og"}).code == 0);
    CHECK(frame("discs") == discs);
    CHECK(frame("discs-og") != og);
    CHECK(run_suite(folder, faster + entries_of_discs, {"--only", "discs-og,faster"}).code == 0);
    CHECK(contains(call({"snapshot", "rings-and-ball"}).err,
                   "there is no suite 'rings-and-ball' (did you mean 'rings-and-balls'?)"));
    CHECK(contains(run_suite(folder, faster + entries_of_discs, {"--only", "dics"}).err,
                   "unknown entry 'dics' (did you mean 'discs'?)"));
    CHECK(contains(run_suite(folder, faster + entries_of_discs, {"--update", "--only", "faster"}).err,
                   "'faster' is a control without a baseline of its own; update 'discs'"));
  }

  TEST_CASE("suite: an update with a failed or an interrupted run keeps every baseline") {
    const TemporaryFolder folder;
    REQUIRE(run_suite(folder, short_runs + entries_of_discs, {"--update"}).code == 0);
    const std::string frame = text_of(folder / "suite/discs/frame_00001.png");
    const std::string faster = replaced_once(short_runs, "until = 0.001", "until = 0.02, speed = 2.5");
    const std::string diverges =
        faster + replaced_once(entries_of_discs, "method = \"og\"", "method = \"og\"\nset = { cfl = 20 }");
    const Outcome failed = run_suite(folder, diverges, {"--update"});
    CHECK(failed.code == 3);
    CHECK(contains(failed.out, "not updated, since another run has no result"));
    CHECK(text_of(folder / "suite/discs/frame_00001.png") == frame);
    const std::string endless =
        faster + replaced_once(entries_of_discs, "method = \"og\"", "method = \"og\"\nset = { until = 1e4 }");
    const std::string command = "timeout --preserve-status -s TERM 2 " TAUT_BINARY_DIR "/taut snapshot " +
                                write_suite(folder, endless) + " --update --quiet --jobs 1 --out " +
                                folder.str("out");
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 143);
    CHECK(text_of(folder / "suite/discs/frame_00001.png") == frame);
    CHECK(files_in(folder / "suite") == 2);
  }

  TEST_CASE("suite: JSON, JUnit and annotations name entry and frame") {
    const TemporaryFolder folder;
    REQUIRE(run_suite(folder, short_runs + entries_of_discs, {"--update"}).code == 0);
    const std::string faster = replaced_once(short_runs, "until = 0.001", "until = 0.001, speed = 2.5");
    ::setenv("GITHUB_ACTIONS", "true", 1);
    const Outcome outcome =
        run_suite(folder, faster + entries_of_discs, {"--json", "--junit", folder.str("suite.xml")});
    ::unsetenv("GITHUB_ACTIONS");
    CHECK(
        contains(outcome.err, "::error title=taut snapshot%3A discs/frame_00000.png::discs/frame_00000.png"));
    const auto json = nlohmann::ordered_json::parse(outcome.out);
    CHECK(json["answer"] == "snapshot");
    CHECK(json["passed"] == false);
    REQUIRE(json["entries"].size() == 3);
    CHECK(json["entries"][0]["result"] == "different");
    CHECK(json["entries"][0]["pictures"].size() == 3);
    CHECK(json["entries"][0]["settings"]["speed"] == 2.5);
    CHECK(json["entries"][2]["differs_from"] == "discs");
    CHECK(json["entries"][2]["settings"]["speed"] == 4);
    CHECK(json["entries"][2]["passed"] == true);
    const std::string junit = text_of(folder / "suite.xml");
    CHECK(contains(junit, "name=\"discs/frame_00002.png\""));
    CHECK(contains(junit, "classname=\"taut.snapshot\" name=\"faster\"/>"));
  }

  TEST_CASE("suite: an invalid suite file is refused with the reason") {
    const std::string entry = "[[entry]]\nname = 'discs'\nscene = 'discs.toml'\n";
    CHECK(contains(refusal_of_suite("titel = 'x'\n" + entry), "suite.toml:1:1: "));
    CHECK(contains(refusal_of_suite("titel = 'x'\n" + entry), "did you mean 'title'"));
    CHECK(contains(refusal_of_suite(entry + "method = 'ogg'\n"), "suite.toml:4:10: "));
    CHECK(contains(refusal_of_suite(entry + "set = { speeed = 3 }\n"), "suite.toml:4:"));
    CHECK(contains(refusal_of_suite(entry + "set = { speeed = 3 }\n"), "did you mean 'speed'"));
    CHECK(contains(refusal_of_suite(entry + "render = { colour = 'speed' }\n"), "did you mean 'color'"));
    CHECK(contains(refusal_of_suite(entry + "render = { color = 'sped' }\n"),
                   "suite.toml:4:20: unknown field 'sped' (did you mean 'speed'"));
    CHECK(contains(refusal_of_suite(entry + "render = { camera = [1, 0, 0] }\n"), "suite.toml:1:"));
    CHECK(contains(refusal_of_suite(entry + "warn = 5\nfail = 5\n"), "warn must be less than fail"));
    CHECK(contains(refusal_of_suite(entry + "fail = -1\n"), "suite.toml:4:8: fail = -1 must be at least 0"));
    CHECK(contains(refusal_of_suite(entry + "until = 1\nset = { until = 1 }\n"), "set the same value"));
    CHECK(contains(refusal_of_suite(entry + entry), "the name 'discs' is already in use"));
    CHECK(contains(refusal_of_suite("[[entry]]\nname = 'discs'\nscene = 'colliding-ring'\n"),
                   "did you mean 'colliding-rings'"));
    CHECK(contains(refusal_of_suite(entry + "[[entry]]\nname = 'b'\ndiffers_from = 'disc'\n"),
                   "suite.toml:6:16: unknown entry 'disc' (did you mean 'discs'?)"));
    CHECK(contains(refusal_of_suite(entry + "differs_from = 'discs'\n"), "leave scene out"));
    CHECK(contains(refusal_of_suite("baselines = 'x'\n"), "entry"));
  }

  TEST_CASE("suite: missing baselines are refused before any run, and --list runs nothing") {
    const std::string error = refusal_of_suite(entries_of_discs);
    CHECK(contains(error, "there is no baseline of discs, discs-og in"));
    CHECK(contains(error, "--update --only discs,discs-og"));
    CHECK(contains(refusal_of_suite(entries_of_discs, {"--method", "og"}), "--method is for scenes"));
    CHECK(contains(refusal_of_suite(entries_of_discs, {"--every", "1"}), "write `frames` into `render`"));
    CHECK(contains(refusal_of_suite(entries_of_discs, {"--history", "1"}), "into the scene file"));
    const TemporaryFolder folder;
    const Outcome list = run_suite(folder, entries_of_discs, {"--list"});
    CHECK(list.code == 0);
    CHECK(contains(list.out, "must differ from discs"));
    CHECK_FALSE(fs::exists(folder / "out"));
    Texts words = tiny_run(folder, "out", {"--baseline", folder.str("base"), "--list"});
    words[0] = "snapshot";
    CHECK(contains(program(words).err, "--list is for suites"));
  }

  TEST_CASE("suite: the shipped suite passes") {
    const TemporaryFolder folder;
    const Outcome outcome =
        program({"snapshot", "rings-and-balls", "--out", folder.str("out"), "--jobs", "1", "--quiet"});
    CAPTURE(outcome.out);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
  }
}
