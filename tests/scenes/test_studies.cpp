#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <sys/wait.h>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/text/format.hpp"
#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

Outcome study(const TemporaryFolder& folder, const std::string& command) {
  const std::string line = "cd '" + folder.path().string() +
                           "' && TAUT='" TAUT_BINARY_DIR "/taut' '" TAUT_SOURCE_DIR "/scenes/studies/'" +
                           command + " >out.txt 2>err.txt";
  const int status = std::system(line.c_str());
  return {WEXITSTATUS(status), text_of(folder / "out.txt"), text_of(folder / "err.txt")};
}

const fs::path known_answers = fs::path(TAUT_SOURCE_DIR) / "scenes/studies/results/known-answers.md";

bool ffmpeg_is_there() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the study of an image sequence writes frames and a panel, and movies if ffmpeg is there") {
    const TemporaryFolder folder;
    const Outcome outcome = study(folder, "rings-movie.sh rings 0.005 12");
    CAPTURE(outcome.err);
    CHECK(outcome.code == (ffmpeg_is_there() ? 0 : 4));
    for (const char* frames : {"og/frames", "enog/frames", "close"})
      CHECK(files_in(folder / ("rings/" + std::string(frames))) == 13);
    CHECK(fs::exists(folder / "rings/panel.png"));
    CHECK(fs::exists(folder / "rings/rings.mp4") == ffmpeg_is_there());
    CHECK(fs::exists(folder / "rings/close.gif") == ffmpeg_is_there());
  }

  TEST_CASE("the study of a sweep derives its answer from the results") {
    const TemporaryFolder folder;
    const Outcome outcome = study(folder, "rings-sweep.sh rings 0.005");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "0 of 24 runs are done"));
    CHECK(lines_of(folder / "rings/results.csv").size() == 25);
    for (const std::string method : {"og", "oas", "enog"}) {
      std::string limit = "none";
      const auto results = json_of(folder / "rings/results.json");
      for (const auto& run : results["runs"]) {
        if (run["set"]["method"] != method) continue;
        if (run["verdict"] != "stable") break;
        limit = run["set"]["v0"].dump();
      }
      CHECK(contains(outcome.out, "\n  " + method + " " + limit + "\n"));
    }
    CHECK(contains(study(folder, "rings-sweep.sh rings 0.005").out, "24 of 24 runs are done"));
  }

  TEST_CASE("the study of the papers' figures writes panels and a history") {
    const TemporaryFolder folder;
    const Outcome rings = study(folder, "paper-figures.sh zhang-14 rings 0.005");
    CAPTURE(rings.err);
    CHECK(rings.code == 0);
    CHECK(fs::exists(folder / "rings/zhang-14.png"));
    const auto record = json_of(folder / "rings/oas/run.json");
    CHECK(record["parameters"]["v0"] == 0.08);
    const Outcome plate = study(folder, "paper-figures.sh khayyer-10 plate 0.25");
    CAPTURE(plate.err);
    CHECK(plate.code == 0);
    CHECK(fs::exists(folder / "plate/khayyer-10.png"));
    CHECK(json_of(folder / "plate/d-ulsph-r-as-4/run.json")["spacing"] == 0.0625);
    CHECK(study(folder, "paper-figures.sh khayyer-12 corner 0.2").code == 0);
    CHECK(contains(lines_of(folder / "corner/tic/history.csv").front(), ",corner_x,corner_y,"));
    CHECK(study(folder, "paper-figures.sh zhang-99 none").code == 2);
    const Outcome cable = study(folder, "paper-figures.sh Lee2016.fig-3 cable end_velocity");
    CAPTURE(cable.err);
    CHECK(cable.code == 0);
    CHECK(contains(cable.out, "all 1 agree"));
    CHECK(fs::exists(folder / "cable/Lee2016.fig-3.png"));
    const Outcome none = study(folder, "paper-figures.sh Lee2016.fig-99 none");
    CHECK(none.code == 2);
    CHECK(contains(none.err, "no claim is about 'Lee2016.fig-99'"));
  }

  TEST_CASE("one command runs a study and makes its tables") {
    const TemporaryFolder folder;
    const auto write_study = [&](const std::string& name, const std::string& more) {
      std::ofstream(folder / (name + ".toml")) << "title = \"Small\"\nscene = \"colliding-rings\"\n" + more;
    };
    write_study("small-accuracy",
                "[grid]\nspacing = [0.005, 0.0025]\nmethod = [\"oenog\", \"og\"]\n"
                "[chart]\nmeasure = [\"diameter_rmse\", \"rebound_ratio\"]\n");
    write_study(
        "small-map",
        "set = { spacing = 0.005 }\n[grid]\nv0 = [0.02, 0.06]\nmethod = [\"oenog\", \"og\"]\n[map]\n");
    write_study("small-history",
                "set = { spacing = 0.005 }\n[grid]\nmethod = [\"oenog\", \"og\"]\n"
                "[history]\ntotal_energy = \"energy, J\"\n");
    const auto tables_of = [&](const std::string& name) {
      const Outcome outcome = study(folder, "update-results.sh --to made " + name + ".toml");
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      return text_of(folder / ("made/" + name + ".md"));
    };
    const std::string accuracy = tables_of("small-accuracy");
    const auto chart = json_of(folder / "out/small-accuracy/results.json");
    CHECK(accuracy.starts_with("# Small\n"));
    CHECK(contains(accuracy, "| method | 5 mm | 2.5 mm | order | finest, s |"));
    CHECK(contains(accuracy, "error of rebound_ratio, % of the reference"));
    CHECK(contains(accuracy, "| method | within 5 % | within 1 % | within 0.5 % |"));
    for (const auto& run : chart["runs"])
      if (run["set"]["method"] == "oenog")
        CHECK(contains(accuracy, " " + percent(run["measures"]["rebound_ratio"]["error"]) + " "));
    const std::string map = tables_of("small-map");
    CHECK(contains(map, "| v0, c0 | 0.02 | 0.06 |"));
    CHECK(contains(map, "| `oenog` | stable | stable |"));
    const std::string history = tables_of("small-history");
    CHECK(contains(history, "| run | verdict | touch_time |"));
    CHECK(tables_of("small-history") == history);
  }

  TEST_CASE(
      "the study of limitations reproduces the stored results of the truss, and every run in METHODS.md is stored") {
    const TemporaryFolder folder;
    const Outcome outcome = study(folder, "limitations.sh made.md truss");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const std::string made = text_of(folder / "made.md"),
                      stored = text_of(fs::path(TAUT_SOURCE_DIR) / "scenes/studies/results/limitations.md");
    const std::size_t first = made.find("\n**`taut run truss");
    REQUIRE(first != std::string::npos);
    CHECK(contains(made, "  extension  "));
    CHECK(contains(stored, made.substr(first)));
    const std::string methods = text_of(fs::path(TAUT_SOURCE_DIR) / "engine/METHODS.md");
    static const std::regex command("`taut run [^`]*`");
    for (std::sregex_iterator found(methods.begin(), methods.end(), command), end; found != end; ++found)
      CHECK_MESSAGE(contains(stored, "**" + found->str() + "**"), found->str());
  }

  TEST_CASE("the study of known answers reproduces the stored rows of two situations") {
    const TemporaryFolder folder;
    const Outcome outcome = study(folder, "known-answers.sh made.md block-on-wall disc-on-wall");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const std::string made = text_of(folder / "made.md"), stored = text_of(known_answers);
    CHECK(contains(made, "\n|  | support force | 98.1 N/m | 1.000 | "));
    CHECK(contains(made, "\n| disc-on-wall | verdict |  | stable | "));
    std::istringstream lines(made);
    for (std::string line; std::getline(lines, line);) CHECK_MESSAGE(contains(stored, line + "\n"), line);
  }

  TEST_CASE("every situation with a known answer has a stored verdict and an answer for each measure") {
    const std::string stored = text_of(known_answers);
    int situations = 1;  // oblique-discs
    for (const auto& entry :
         fs::directory_iterator(known_answers.parent_path().parent_path() / "known-answers")) {
      const std::string name = entry.path().stem().string();
      CAPTURE(name);
      ++situations;
      const Scene scene = read_scene(entry.path()).scene;
      CHECK_FALSE(scene.measures.empty());
      for (const std::string law : {"neo_hookean", "2d_deviator"}) {
        if (name == "shrink-fit" && law == "2d_deviator")
          continue;  // methods of this law refuse `displacement`
        CAPTURE(law);
        for (const Measure& measure : scene.measures) CHECK(scene.references.at(law).has(measure.name));
      }
      CHECK(contains(stored, "\n| " + name + " | verdict |"));
    }
    CHECK(situations == 12);
  }

  TEST_CASE("every study with a picture has its generated tables") {
    const fs::path studies = fs::path(TAUT_SOURCE_DIR) / "scenes/studies";
    int tables = 0;
    for (const auto& entry : fs::directory_iterator(studies)) {
      const std::string text = entry.path().extension() == ".toml" ? text_of(entry.path()) : "";
      if (!contains(text, "\n[chart]") && !contains(text, "\n[map]") && !contains(text, "\n[history]"))
        continue;
      const std::string page = text_of(studies / "results" / (entry.path().stem().string() + ".md"));
      CAPTURE(entry.path().string());
      CHECK(contains(page, "Made by `taut sweep` from the stored results"));
      CHECK(contains(page, "\n| --- |"));
      ++tables;
    }
    CHECK(tables == 15);
  }

  TEST_CASE("the study of a snapshot test makes a baseline, then passes, then finds a change") {
    const TemporaryFolder folder;
    const Outcome first = study(folder, "snapshot-in-ci.sh baseline");
    CHECK(first.code == 0);
    CHECK(contains(first.out, "the first call"));
    CHECK(files_in(folder / "baseline") == 6);  // five frames and look.json
    CHECK(study(folder, "snapshot-in-ci.sh baseline").code == 0);
    const Outcome changed = study(folder, "snapshot-in-ci.sh baseline --set v0=0.07");
    CHECK(changed.code == 1);
    CHECK(contains(changed.out, "out/snapshot-baseline/difference.png"));
  }

  TEST_CASE("the study of a test of numbers passes, and finds a change") {
    const TemporaryFolder folder;
    const Outcome same = study(folder, "numbers-in-ci.sh");
    CAPTURE(same.out);
    CHECK(same.code == 0);
    const Outcome moved = study(folder, "numbers-in-ci.sh --set vf=0.06");
    CHECK(moved.code == 1);
    CHECK(contains(moved.out, "MOVED"));
  }
}

}  // namespace of_this_file
