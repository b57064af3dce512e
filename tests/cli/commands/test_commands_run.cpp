#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "render/image/png.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

std::vector<std::string> keys(const nlohmann::ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

std::vector<double> numbers(const std::string& row) {
  std::vector<double> values;
  std::istringstream text(row);
  for (std::string cell; std::getline(text, cell, ',');) values.push_back(std::stod(cell));
  return values;
}

/// `text` starts with top-level keys.
std::string errors_of(const std::string& text, const TemporaryFolder& folder) {
  std::ofstream(folder / "scene.toml")
      << "title = \"Still\"\nuntil = 1e-6\n"
      << text << "[material.rubber]\ndensity = 1000\nyoungs_modulus = 1e7\npoisson_ratio = 0.4\n";
  const Outcome outcome =
      call({"run", folder.str("scene.toml"), "--no-render", "--quiet", "--out", folder.str("out")});
  CHECK(outcome.code == 0);
  return outcome.err;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a body gives a warning only if the mass of its particles differs from the mass of its shape") {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& shape) {
      return errors_of("spacing = 0.1\n[[body]]\nname = \"b\"\nmaterial = \"rubber\"\n" + shape, folder);
    };
    const std::string of_lattice =
        "shape = { type = \"disc\", centre = [0, 0], radius = 0.3, layout = \"lattice\" }\n";
    CHECK(contains(told(of_lattice), "the particles of body 'b' weigh 13.2 % more than its shape"));
    CHECK(contains(json_of(folder / "out/run.json")["remark"], "weigh 13.2 % more"));
    CHECK_FALSE(contains(told("shape = { type = \"disc\", centre = [0, 0], radius = 0.3 }\n"), "weigh"));
    CHECK_FALSE(contains(
        told(of_lattice + "without = [{ type = \"disc\", centre = [0, 0], radius = 0.1 }]\n"), "weigh"));
  }

  TEST_CASE("a wall that starts inside a body gives a warning, and a wall that touches the body does not") {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& floor, const std::string& velocity) {
      return errors_of(
          "spacing = 0.002\n[[body]]\nname = \"disc\"\nmaterial = \"rubber\"\n"
          "shape = { type = \"disc\", centre = [0, 0.02], radius = 0.02 }\nvelocity = [0, " +
              velocity + "]\n[[wall]]\nname = \"floor\"\nnormal = [0, 1]\nat = [0, " + floor + "]\n",
          folder);
    };
    CHECK(contains(told("0.0004", "0"), "J at the start: bodies or walls overlap"));
    CHECK(contains(told("0.0004", "-1"), "% of the kinetic energy: bodies or walls overlap"));
    CHECK_FALSE(contains(told("0", "0"), "contacts store"));
  }

  TEST_CASE(
      "a probe named like a history column is refused, and a line sampled after the end gives a warning") {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& more) {
      const std::string scene = write_tiny_scene(folder);
      std::ofstream(scene, std::ios::app) << more;
      return call({"run", scene, "--out", folder.str("out"), "--quiet", "--no-render", "--until", "1e-4"});
    };
    for (const std::string column : {"t", "kinetic_energy", "pieces"}) {
      const Outcome twice =
          run("[[probe]]\nname = \"" + column + "\"\nof = \"gap\"\nbodies = [\"left\", \"right\"]\n");
      CHECK(twice.code == 2);
      CHECK(contains(twice.err, "history.csv already has a column '" + column + "'"));
    }
    const std::string line =
        "[[line]]\nname = \"cut\"\nbody = \"left\"\nfield = \"pressure\"\n"
        "from = [-0.015, 0]\nto = [-0.007, 0]\npoints = 3\ntimes = ";
    const Outcome late = run(line + "[0.5]\n");
    CHECK(late.code == 0);
    CHECK(contains(
        late.err, "line 'cut' has no samples at its times after the end of the run, 0.0001 s: 1 of 1 times"));
    CHECK_FALSE(contains(run(line + "[1e-4]\n").err, "no sample"));
    const Outcome nowhere = call({"run", write_tiny_scene(folder), "--out", ""});
    CHECK(nowhere.code == 2);
    CHECK(contains(nowhere.err, "--out is empty"));
  }

  TEST_CASE("the replacement of an older run is reported only if the new run can start") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render", "--until", "1e-4"})).code == 0);
    const Outcome hidden = call(tiny_run(folder, "out", {"--cut", "x > -1", "--until", "1e-4"}));
    CHECK(hidden.code == 2);
    CHECK_FALSE(contains(hidden.err, "is replaced"));
    CHECK(contains(call(tiny_run(folder, "out", {"--no-render", "--until", "1e-4"})).err, "is replaced"));
  }

  TEST_CASE("a scene with lines writes lines.csv, and its steps do not depend on the lines") {
    const TemporaryFolder folder;
    std::string scene = text_of(fs::path(TAUT_SOURCE_DIR) / "scenes/heterogeneous-cable.toml");
    const std::string times = "times = [1.0e-4, 1.5e-4, 2.0e-4, 2.5e-4, 3.0e-4, 3.5e-4]";
    const auto run_with = [&](const std::string& name, const std::string& line_times) {
      std::string text = scene;
      text.replace(text.find(times), times.size(), "times = " + line_times);
      const std::string path = folder.str(name + ".toml");
      std::ofstream(path) << text;
      const Outcome outcome =
          call({"run", path, "--spacing", "0.024", "--until", "5e-5", "--no-render", "--method",
                "d-ulsph-r-tic", "--out", folder.str(name), "--threads", "1", "--quiet"});
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return json_of(folder / name / "run.json");
    };
    const auto record = run_with("two", "[1e-5, 4.1e-5]");
    const std::vector<std::string> rows = lines_of(folder / "two/lines.csv");
    REQUIRE(rows.size() == 1 + 2 * 400);
    CHECK(rows[0] == "line,t,step,x,y,value,reference");
    double squared = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
      REQUIRE(rows[k].starts_with("stress,"));
      const std::vector<double> row = numbers(rows[k].substr(7));
      REQUIRE(row.size() == 6);
      CHECK(row[0] == (k <= 400 ? 1e-5 : 4.1e-5));
      squared += (row[4] - row[5]) * (row[4] - row[5]) / 800;
    }
    CHECK(numbers(rows[1].substr(7))[2] == Approx(0.024));
    CHECK(numbers(rows[400].substr(7))[2] == Approx(1.976));
    CHECK(record["measures"]["stress_rmse"]["value"].get<double>() == Approx(std::sqrt(squared)));
    const auto other = run_with("late", "[4.7e-5, 1]");
    CHECK(other["steps"] == record["steps"]);
    CHECK(other["reached"] == record["reached"]);
    CHECK(other["measures"]["stress_rmse"]["value"].is_null());
    CHECK(lines_of(folder / "late/lines.csv").size() == 401);
    CHECK(lines_of(folder / "late/history.csv") == lines_of(folder / "two/history.csv"));
  }

  TEST_CASE("a run writes frames, a history and a record") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out"));
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err ==
          "taut: the picture has no room for any text; use a larger --size, or fewer texts with --text\n");
    CHECK(contains(outcome.out, folder.str("out/frames")));
    CHECK(contains(outcome.out, "touch_time"));

    CHECK(files_in(folder / "out") == 4);
    CHECK(files_in(folder / "out/frames") == 5);
    const taut::render::Image last = taut::render::read_png(folder / "out/frames/frame_00004.png");
    CHECK(last.width == 160);
    CHECK(last.height == 120);

    const auto record = json_of(folder / "out/run.json");
    CHECK(keys(record) ==
          std::vector<std::string>{"taut",         "format",       "scene",
                                   "method",       "material_law", "contact",
                                   "stepping",     "cfl",          "parameters",
                                   "dim",          "spacing",      "particles",
                                   "mass",         "until",        "reached",
                                   "status",       "steps",        "threads",
                                   "machine",      "seconds",      "particle_steps_per_second",
                                   "verdict",      "since",        "indicators",
                                   "conservation", "energy_note",  "measures",
                                   "provenance"});
    CHECK(record["status"] == "finished");
    CHECK(record["verdict"] == "stable");
    CHECK(record["scene"] == "discs");
    CHECK(record["contact"] == "sph");
    CHECK(record["parameters"]["speed"] == 2.0);
    CHECK(record["reached"].get<double>() >= 0.002);
    CHECK(keys(record["indicators"]) == std::vector<std::string>{"pieces", "hourglass_error",
                                                                 "pressure_checkerboard",
                                                                 "von_mises_checkerboard"});
    CHECK(record["indicators"]["pieces"] == 2);
    for (const char* key : {"hourglass_error", "pressure_checkerboard", "von_mises_checkerboard"}) {
      CAPTURE(key);
      const auto& indicator = record["indicators"][key];
      CHECK(keys(indicator) == std::vector<std::string>{"greatest", "at", "last"});
      CHECK(indicator["greatest"].get<double>() > 0);
      CHECK(indicator["greatest"].get<double>() < 1);
      CHECK(indicator["at"].get<double>() > 0);
      CHECK(indicator["at"].get<double>() <= record["reached"].get<double>());
    }
    const std::vector<double> end = numbers(lines_of(folder / "out/history.csv").back());
    CHECK(record["indicators"]["hourglass_error"]["last"] == end[10]);
    CHECK(record["indicators"]["pressure_checkerboard"]["last"] == end[11]);
    CHECK(record["indicators"]["von_mises_checkerboard"]["last"] == end[12]);
    CHECK(record["measures"]["touch_time"]["unit"] == "s");
    CHECK(record["measures"]["touch_time"]["reference"].is_null());
    CHECK(record["conservation"]["linear_momentum"].get<double>() < 1e-10);
    CHECK(record["mass"].get<double>() == Approx(record["particles"].get<double>() * 4e-6 * 1000));
  }

  TEST_CASE(
      "a jittered run records its jitter in run.json and scene.toml, and scene.toml gives the same run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render", "--set", "jitter=0.1", "--set", "jitter_seed=4"}))
                .code == 0);
    const auto record = json_of(folder / "out/run.json");
    CHECK(record["jitter"] == 0.1);
    CHECK(record["jitter_seed"] == 4);
    const std::string scene = text_of(folder / "out/scene.toml");
    CHECK(contains(scene, "jitter = 0.1\n"));
    CHECK(contains(scene, "jitter_seed = 4\n"));
    CHECK(contains(call({"describe", (folder / "out/scene.toml").string()}).out, "0.1 dp, seed 4"));
    REQUIRE(call({"run", (folder / "out/scene.toml").string(), "--no-render", "--out",
                  (folder / "again").string()})
                .code == 0);
    CHECK(text_of(folder / "again/history.csv") == text_of(folder / "out/history.csv"));
    REQUIRE(call(tiny_run(folder, "lattice", {"--no-render"})).code == 0);
    CHECK(text_of(folder / "lattice/history.csv") != text_of(folder / "out/history.csv"));
  }

  TEST_CASE("the folder name contains the value of the spacing, and a rounded spacing is reported") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const Outcome divided =
        call({"run", scene, "--no-render", "--quiet", "--until", "1e-5", "--set", "spacing=0.005/2"});
    const Outcome rounded =
        call({"run", scene, "--no-render", "--quiet", "--until", "1e-5", "--set", "spacing=0.0021"});
    fs::current_path(before);
    CHECK(divided.code == 0);
    CHECK(fs::exists(folder / "out/discs-enog-spacing=0.0025-until=1e-05/run.json"));
    CHECK_FALSE(contains(divided.out, "does not divide"));
    CHECK(contains(rounded.out, "0.0021 m does not divide the first body"));
    CHECK(json_of(folder / "out/discs-enog-spacing=0.0021-until=1e-05/run.json")["spacing_asked"] == 0.0021);
  }

  TEST_CASE("a link in place of a run's frames or particles is refused, and its target stays untouched") {
    for (const char* inner : {"frames", "particles"}) {
      CAPTURE(inner);
      const TemporaryFolder folder;
      REQUIRE(call(tiny_run(folder, "out", {"--until", "1e-5", "--save-particles"})).code == 0);
      fs::remove_all(folder / "out" / inner);
      fs::create_directory(folder / "elsewhere");
      std::ofstream(folder / "elsewhere/frame_00000.png") << "mine";
      fs::create_directory_symlink(folder / "elsewhere", folder / "out" / inner);
      const Outcome again = call(tiny_run(folder, "out", {"--until", "1e-5", "--save-particles"}));
      CHECK(again.code == 2);
      CHECK(contains(again.err, std::string(inner) + "' is a link"));
      CHECK(call({"render", folder.str("out"), "--quiet"}).code == 2);
      CHECK(text_of(folder / "elsewhere/frame_00000.png") == "mine");
      CHECK(files_in(folder / "elsewhere") == 1);
    }
  }

  TEST_CASE("history has a row for the start and for the end, and no duplicates") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    const std::vector<std::string> lines = lines_of(folder / "out/history.csv");
    REQUIRE(lines.size() > 3);
    CHECK(
        lines[0] ==
        "t,step,kinetic_energy,strain_energy,total_energy,momentum_x,momentum_y,angular_momentum,gap,pieces,"
        "hourglass_error,pressure_checkerboard,von_mises_checkerboard");
    CHECK(text_of(folder / "out/history.csv").back() == '\n');
    CHECK(files_in(folder / "out/frames") == 0);
    double step = -1;
    for (std::size_t k = 1; k < lines.size(); ++k) {
      const std::vector<double> row = numbers(lines[k]);
      REQUIRE(row.size() == 13);
      CHECK(row[1] > step);
      step = row[1];
      CHECK(row[4] == Approx(row[2] + row[3]));
    }
    const auto record = json_of(folder / "out/run.json");
    CHECK(numbers(lines[1])[0] == 0);
    CHECK(numbers(lines.back())[0] == record["reached"].get<double>());
    CHECK(numbers(lines.back())[1] == record["steps"].get<double>());
  }

  TEST_CASE("a row of the history is the first step at or past its time") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "all", {"--no-render", "--history", "1e-9"})).code == 0);
    REQUIRE(call(tiny_run(folder, "some", {"--no-render", "--history", "5e-4"})).code == 0);
    const std::vector<std::string> all = lines_of(folder / "all/history.csv");
    const std::vector<std::string> some = lines_of(folder / "some/history.csv");
    REQUIRE(some.size() == 6);
    std::size_t at = 1;
    for (std::size_t k = 1; k < some.size(); ++k) {
      while (at + 1 < all.size() && numbers(all[at])[0] < 5e-4 * static_cast<double>(k - 1)) ++at;
      CHECK(some[k] == all[at]);
    }
  }

  TEST_CASE(
      "frames of runs with different steps have the same texts, and are alike after a rounding difference") {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& name, const std::string& cfl) {
      REQUIRE(call(tiny_run(folder, name, {"--size", "320x240", "--set", cfl})).code == 0);
      return json_of(folder / (name + "/run.json"))["steps"].get<int>();
    };
    const int steps = run("one", "cfl=0.2");
    CHECK(run("rounded", "cfl=0.2*(1+1e-12)") == steps);
    CHECK(run("other", "cfl=0.19") > steps);
    const auto picture = [&](const std::string& name, int k) {
      return taut::render::read_png(folder / (name + "/frames/frame_0000" + std::to_string(k) + ".png"));
    };
    const int header = 27;  // rows: 3 em of 9 pixels
    for (int k = 0; k <= 4; ++k) {
      CAPTURE(k);
      const taut::render::Image one = picture("one", k), rounded = picture("rounded", k),
                                other = picture("other", k);
      const auto texts = [&](const taut::render::Image& image) {
        const auto bytes = 4 * static_cast<std::size_t>(image.width * header);
        return std::vector(image.pixels.begin(), image.pixels.begin() + static_cast<std::ptrdiff_t>(bytes));
      };
      CHECK(texts(rounded) == texts(one));
      CHECK(texts(other) == texts(one));
      CHECK((k > 0) == (texts(one) != texts(picture("one", 0))));
    }
    CHECK(call({"diff", folder.str("one/frames"), folder.str("rounded/frames")}).code == 0);
  }

  TEST_CASE("an older run in the folder is replaced, and other files in it stay untouched") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--frames", "9"})).code == 0);
    std::ofstream(folder / "out/frames/mine.png") << "mine";
    REQUIRE(call(tiny_run(folder, "out", {"--frames", "2"})).code == 0);
    CHECK(files_in(folder / "out/frames") == 4);
    CHECK(text_of(folder / "out/frames/mine.png") == "mine");
  }

  TEST_CASE("a folder with foreign contents is refused, and a run with an invalid run.json is replaced") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out");
    CHECK(call(tiny_run(folder, "out", {"--frames", "1"})).code == 0);
    fs::create_directories(folder / "foreign");
    for (const std::string content : {"{}", "{\"tau\": 1}", "no json"}) {
      for (const char* name : {"out", "foreign"}) std::ofstream(folder / name / "run.json") << content;
      const Outcome foreign = call(tiny_run(folder, "foreign"));
      CHECK(foreign.code == 2);
      CHECK(contains(foreign.err, "--out"));
      CHECK(text_of(folder / "foreign/run.json") == content);
      const Outcome replaced = call(tiny_run(folder, "out", {"--frames", "1"}));
      CHECK(replaced.code == 0);
      CHECK(contains(replaced.err, "the older run in '" + folder.str("out") + "' is replaced"));
    }
    CHECK(call(tiny_run(folder, "discs.toml")).code == 2);
  }

  TEST_CASE(
      "a run with an automatic range draws every frame, and a change of field makes the range automatic") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "auto", {"--range", "auto", "--color", "speed"})).code == 0);
    REQUIRE(call(tiny_run(folder, "signed", {"--color", "pressure"})).code == 0);
    CHECK(files_in(folder / "auto/frames") == 5);
    CHECK(files_in(folder / "signed/frames") == 5);
    CHECK(contains(text_of(folder / "signed/scene.toml"), "range = \"auto\""));
  }

  TEST_CASE("run.json contains the requested spacing if it was rounded") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render", "--spacing", "0.0021"})).code == 0);
    const auto record = json_of(folder / "out/run.json");
    CHECK(record["spacing_asked"] == 0.0021);
    CHECK(record["spacing"].get<double>() == Approx(0.002));
  }

  TEST_CASE("the name of a run's folder contains the settings that differ from the scene") {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const auto run = [&](std::vector<std::string> more) {
      more.insert(more.begin(),
                  {"run", write_tiny_scene(folder), "--no-render", "--quiet", "--threads", "1"});
      return call(more);
    };
    const Outcome first = run({"--set", "speed=2.5", "--until", "1e-5"});
    CHECK(first.err.empty());
    CHECK(fs::exists("out/discs-enog-speed=2.5-until=1e-05/run.json"));
    const Outcome again = run({"--set", "speed=5/2", "--until", "1e-5"});
    CHECK(contains(again.err, "the older run in 'out/discs-enog-speed=2.5-until=1e-05' is replaced"));
    const Outcome refused =
        run({"--method", "oenog", "--spacing", "0.03", "--out", "out/discs-enog-speed=2.5-until=1e-05"});
    CHECK(refused.code == 2);
    CHECK_FALSE(contains(refused.err, "is replaced"));
    CHECK(run({"--method", "oenog", "--spacing", "1/250", "--until", "1e-5/2"}).code == 0);
    CHECK(fs::exists("out/discs-oenog-spacing=0.004-until=5e-06/run.json"));
    CHECK(run({"--set", "speed=2", "--spacing", "0.002", "--until", "0.002"}).code == 0);
    CHECK(fs::exists("out/discs-enog/run.json"));
    CHECK(run({"--method", "oenog", "--set", "method.damping=0", "--spacing", "0.004"}).code == 0);
    CHECK(fs::exists("out/discs-oenog-method.damping=0-spacing=0.004/run.json"));
    CHECK(call({"run", "out/discs-enog-speed=2.5-until=1e-05/scene.toml", "--no-render", "--quiet"}).code ==
          0);
    CHECK(fs::exists("out/discs-enog-speed=2.5-until=1e-05-again/run.json"));
    CHECK(call({"run", "out/discs-enog/scene.toml", "--no-render", "--quiet", "--method", "oenog", "--set",
                "speed=2.5"})
              .code == 0);
    CHECK(fs::exists("out/discs-enog-again-oenog-speed=2.5/run.json"));
    fs::current_path(before);
  }

  TEST_CASE("options without effect, a view without particles and a cfl above its limit are reported") {
    const TemporaryFolder folder;
    const Outcome drawn = call(
        tiny_run(folder, "out", {"--no-render", "--color", "speed", "--font-size", "9", "--frames", "3"}));
    CHECK(drawn.code == 0);
    CHECK(contains(drawn.err, "without effect, since no frames are drawn: --color, --font-size, --frames"));
    const Outcome beside = call(tiny_run(folder, "beside", {"--view", "5:6:0:1"}));
    CHECK(beside.code == 0);
    CHECK(contains(beside.err, "the view shows no particle in any frame"));
    CHECK(contains(json_of(folder / "beside/run.json")["remark"], "the view shows no particle"));
    CHECK_FALSE(json_of(folder / "out/run.json")["remark"].get<std::string>().empty());
    CHECK(call(tiny_run(folder, "many", {"--no-render", "--threads", "10000"})).code == 2);
    const Outcome diverged = call(tiny_run(folder, "cfl", {"--no-render", "--set", "cfl=20"}));
    CHECK(diverged.code == 3);
    CHECK(contains(diverged.err, "cfl = 20 is above"));
  }

  TEST_CASE("a law of the scene that the method does not support gives a warning, and the run continues") {
    const TemporaryFolder folder;
    const auto run_with = [&](const std::string& method) {
      std::vector<std::string> arguments = tiny_run(folder, method, {"--no-render", "--method", method});
      std::string scene = text_of(folder / "discs.toml");
      const std::string enog = "method = \"enog\"";
      scene.replace(scene.find(enog), enog.size(), "method = \"tl\"\nlaw = \"mooney-rivlin\"");
      std::ofstream(folder / "discs.toml") << scene;
      return call(arguments);
    };
    const Outcome oenog = run_with("oenog");
    CHECK(oenog.code == 0);
    CHECK(oenog.err.empty());
    CHECK(json_of(folder / "oenog/run.json")["material_law"] == "mooney_rivlin");
    const Outcome enog = run_with("enog");
    CHECK(enog.code == 0);
    CHECK(enog.err ==
          "taut: the method 'enog' does not support the law of the scene, 'mooney-rivlin'; "
          "it runs with its own law\n");
    CHECK(json_of(folder / "enog/run.json")["material_law"] == "2d_deviator");
    CHECK(call(tiny_run(folder, "none", {"--no-render", "--method", "enog", "--set", "law=linear"})).code ==
          2);
  }

  TEST_CASE("progress goes to stderr, in lines") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = tiny_run(folder, "out", {"--no-render"});
    std::erase(arguments, "--quiet");
    const Outcome outcome = call(arguments);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.starts_with("discs, enog, "));
    CHECK(contains(outcome.err, "particle-steps/s"));
    CHECK_FALSE(contains(outcome.err, "\r"));
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("a run of the scene.toml in a run folder gives the bytes of the first run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "a",
                          {"--set", "speed=3", "--frames", "3", "--color", "pressure", "--history", "3e-5",
                           "--until", "0.0011", "--method", "og", "--size", "200x100"}))
                .code == 0);
    REQUIRE(call({"run", folder.str("a/scene.toml"), "--out", folder.str("b"), "--quiet"}).code == 0);
    for (const std::string file :
         {"history.csv", "scene.toml", "frames/frame_00000.png", "frames/frame_00003.png"}) {
      CAPTURE(file);
      CHECK_FALSE(text_of(folder / ("a/" + file)).empty());
      CHECK(text_of(folder / ("a/" + file)) == text_of(folder / ("b/" + file)));
    }
  }

  TEST_CASE("output does not alter a run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "few", {"--frames", "3", "--history", "4.1e-4"})).code == 0);
    REQUIRE(call(tiny_run(folder, "many", {"--every", "0.0001", "--history", "4.1e-4"})).code == 0);
    CHECK(files_in(folder / "many/frames") == 21);
    CHECK(text_of(folder / "few/history.csv") == text_of(folder / "many/history.csv"));
    CHECK(text_of(folder / "few/frames/frame_00003.png") == text_of(folder / "many/frames/frame_00020.png"));
    REQUIRE(call(tiny_run(folder, "dense", {"--no-render", "--history", "1e-7"})).code == 0);
    CHECK(lines_of(folder / "few/history.csv").back() == lines_of(folder / "dense/history.csv").back());
  }
}
