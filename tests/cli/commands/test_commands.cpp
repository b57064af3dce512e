#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "render/image/png.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("a mistyped word is refused with exit code 2 and the nearest name") {
    struct Case {
      std::vector<std::string> arguments;
      std::string expected;
    };
    const std::vector<Case> cases{
        {{"runn"}, "'run'"},
        {{"--versoin"}, "'--version'"},
        {{"run", "colliding-rings", "--colr", "speed"}, "'--color'"},
        {{"run", "--colr"}, "'--color'"},
        {{"run", "colliding-ring"}, "colliding-rings"},
        {{"run", "colliding-rings", "--method", "enogg"}, "'enog'"},
        {{"run", "colliding-rings", "--color", "presure"}, "'pressure'"},
        {{"run", "colliding-rings", "--colormap", "viridi"}, "'viridis'"},
        {{"run", "colliding-rings", "--fail-on", "fracture"}, "'fractured'"},
        {{"run", "colliding-rings", "--set", "v00=1"}, "'v0'"},
        {{"list", "scens"}, "'scenes'"},
        {{"describe", "enogg"}, "'enog'"},
        {{"describe", "coliding-rings"}, "'colliding-rings'"},
    };
    for (const Case& c : cases) {
      CAPTURE(c.expected);
      const Outcome outcome = call(c.arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, c.expected));
      CHECK(outcome.out.empty());
    }
  }

  TEST_CASE("a word after -- is not an option") {
    CHECK(call({"list", "--", "methods"}).code == 0);
    CHECK(contains(call({"describe", "--", "--help"}).err, "unknown name '--help'"));
  }

  TEST_CASE("invalid arguments are refused with exit code 2 before a folder is touched") {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> cases{
        {"--until", "-1"},
        {"--until", "nan"},
        {"--until"},
        {"--until", "1", "--until", "2"},
        {"--spacing", "0"},
        {"--frames", "0"},
        {"--frames", "2.5"},
        {"--frames", "2", "--every", "1"},
        {"--every", "1e-30"},
        {"--history", "1e-30"},
        {"--size", "3x3"},
        {"--size", "big"},
        {"--range", "2:1"},
        {"--range", "1"},
        {"--range", "0:inf"},
        {"--threads", "-1"},
        {"--set", "speed"},
        {"--set", "speed=fast"},
        {"surplus"},
        {"--fields", "speed"},
        {"--save-particles", "--fields", "sped"},
        {"--view", "0:1:2"},
        {"--view", "0:1:2:1"},
        {"--view", "0:1:0:1:2"},
        {"--color", "no-field"},
        {"--fail-on", "stable"},
    };
    for (const auto& wrong : cases) {
      CAPTURE(wrong.front());
      CAPTURE(wrong.back());
      const Outcome outcome = call(tiny_run(folder, "out", wrong));
      CHECK(outcome.code == 2);
      CHECK(outcome.err.starts_with("taut: "));
      CHECK_FALSE(fs::exists(folder / "out"));
    }
  }

  TEST_CASE("an error in a scene names file and line") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    std::ofstream(scene, std::ios::app) << "colour = 1\n";
    const Outcome outcome = call({"run", scene, "--out", folder.str("out")});
    CHECK(outcome.code == 2);
    CHECK(outcome.err.starts_with(scene + ":" + std::to_string(lines_of(scene).size()) + ":1: "));
    CHECK_FALSE(fs::exists(folder / "out"));
  }

  TEST_CASE("help and version go to stdout with exit code 0") {
    const std::string version = call({"--version"}).out;
    CAPTURE(version);
    static const std::regex first_line(R"(taut 0\.2\.0 \(([0-9a-f]{12}(-dirty)?|unknown)\)\n\n(.|\n)*)");
    CHECK(std::regex_match(version, first_line));
    for (const char* text : {"compiler  ", "instruction set  ", " Eigen 3.", " fmt ", ", osmesa ",
                             "file formats     run.json 1, ", "history.csv 1", "checkpoint.bin "})
      CHECK(contains(version, text));
    for (const std::string command :
         {"run", "render", "compare", "movie", "diff", "snapshot", "list", "describe"}) {
      CHECK(contains(call({"--help"}).out, "  " + command + " "));
      const Outcome help = call({command, "--help"});
      CHECK(help.code == 0);
      CHECK(contains(help.out, "Examples:\n  taut " + command));
    }
    CHECK(call({}).code == 2);
  }

  TEST_CASE("list prints the same names as text and as JSON") {
    const Outcome all = call({"list", "all"}), kinds = call({"list"});
    CHECK(all.code == 0);
    CHECK(kinds.code == 0);
    CHECK(std::ranges::count(kinds.out, '\n') < 24);
    const auto json = nlohmann::json::parse(call({"list", "--json"}).out);
    for (const std::string kind : {"scenes", "methods", "equations", "fields", "measures", "colormaps"}) {
      CHECK(nlohmann::json::parse(call({"list", kind, "--json"}).out) == json[kind]);
      CHECK_FALSE(json[kind].empty());
      const std::string count = std::to_string(json[kind].size());
      CHECK(std::regex_search(kinds.out,
                              std::regex("\n? +" + kind + " +" + count + " +taut list " + kind + " ")));
      for (const auto& row : json[kind])
        CHECK(contains(all.out, "  " + row["name"].get<std::string>() + " "));
    }
  }

  TEST_CASE("list names every kind of measure of the scenes, with its keys") {
    const auto listed = nlohmann::json::parse(call({"list", "measures", "--json"}).out);
    std::set<std::string> names;
    for (const auto& row : listed) names.insert(row["name"]);
    CHECK(names.size() == listed.size());
    for (const std::string& scene : scene_names())
      for (const taut::Measure& measure : read_scene(find_scene(scene)).scene.measures) {
        CAPTURE(scene);
        CAPTURE(measure.name);
        CHECK(names.contains(measure.kind));
      }
    const std::string text = call({"list", "measures"}).out;
    CHECK(contains(text, "final_ratio    probe, threshold, scale, free  number"));
    CHECK(contains(text, "path_error     probes, scale                  table or solution"));
    CHECK(contains(call({"describe", "oscillating-plate"}).out, "  period      period"));
  }

  TEST_CASE("describe shows a scene's parameters with units and bounds, and a method's constants") {
    const TemporaryFolder folder;
    const Outcome scene = call({"describe", write_tiny_scene(folder)});
    CHECK(scene.code == 0);
    for (const std::string part : {"Two discs", "speed", "m/s", "0 to inf", "of each disc", "touch_time",
                                   "sph, the default of the method"})
      CHECK(contains(scene.out, part));
    const Outcome method = call({"describe", "enog"});
    CHECK(method.code == 0);
    for (const std::string part :
         {"Zhang2024", "zeta", "conserves", "2d-deviator", "sph by default; also impulse, penalty"})
      CHECK(contains(method.out, part));
    CHECK(contains(call({"describe", "oenog"}).out, "0.8; in 3D 0.9  0.8 to 2; in 3D 0.87 to 0.99"));
  }

  TEST_CASE("describe explains laws, contact laws, fields, colour maps and keys") {
    for (const auto& [name, part] :
         std::map<std::string, std::string>{{"mooney-rivlin", "a law of elasticity"},
                                            {"penalty", "a contact law"},
                                            {"von_mises", "a field"},
                                            {"viridis", "a colour map"},
                                            {"poisson_ratio", "a key of scene"}}) {
      const Outcome outcome = call({"describe", name});
      CAPTURE(name);
      CHECK(outcome.code == 0);
      CHECK(outcome.out.starts_with(name + ", " + part));
    }
    CHECK(nlohmann::json::parse(call({"describe", "spacing", "--json"}).out)[0]["rows"][0]["name"] ==
          "spacing");
    const Outcome unknown = call({"describe", "zzzzzz"});
    CHECK(unknown.code == 2);
    CHECK(std::ranges::count(unknown.err, ',') <= 5);
  }

  TEST_CASE("describe shows how a body is clamped and displaced in 3D, and where a wall is") {
    const TemporaryFolder folder;
    std::ofstream(folder / "brick.toml")
        << "dim = 3\nspacing = 0.1\nuntil = 1\n"
           "[material.m]\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0\n"
           "[[body]]\nname = \"brick\"\nmaterial = \"m\"\n"
           "shape = { type = \"box\", low = [0, 0, 0], high = [1, 1, 1] }\n"
           "held = [\"x < 0.1\", \"\", \"z < 0.1\"]\ndisplacement = [0, \"0.1*y\", 0]\n"
           "[[wall]]\nname = \"floor\"\nat = [0, 0, -3]\nnormal = [0, 0, 2]\n";
    const Outcome scene = call({"describe", (folder / "brick.toml").string()});
    CHECK(scene.code == 0);
    for (const std::string part : {"clamped along x and z in a region, displaced along y at the start",
                                   "through (0, 0, -3) m", "normal (0, 0, 1)"})
      CHECK(contains(scene.out, part));
  }

  TEST_CASE("the exit code of diff distinguishes alike, different and unreadable") {
    const TemporaryFolder folder;
    taut::render::Image image(64, 48);
    taut::render::write_png(image, folder / "white.png");
    image.set(3, 4, {250, 250, 250});
    taut::render::write_png(image, folder / "speck.png");
    for (int column = 0; column < 20; ++column)
      for (int row = 0; row < 20; ++row) image.set(column, row, {200, 0, 0});
    taut::render::write_png(image, folder / "square.png");
    taut::render::write_png(taut::render::Image(64, 47), folder / "lower.png");
    std::ofstream(folder / "text.png") << "no image";
    const auto diff = [&](const std::string& b, const std::vector<std::string>& more = {}) {
      std::vector<std::string> arguments{"diff", folder.str("white.png"), folder.str(b)};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return call(arguments);
    };
    CHECK(diff("white.png").code == 0);
    CHECK(diff("speck.png").code == 0);
    CHECK(diff("speck.png", {"--max-difference", "0"}).code == 1);
    CHECK(diff("white.png", {"--max-difference", "0"}).code == 0);
    CHECK(diff("square.png").code == 1);
    CHECK(diff("square.png", {"--max-difference", "150"}).code == 0);
    CHECK(contains(diff("square.png").out, "100 % of 16x16"));
    CHECK(diff("lower.png").code == 2);
    CHECK(diff("text.png").code == 2);
    CHECK(diff("missing.png").code == 2);
    CHECK(diff("square.png", {"--out", folder.str("diff.png")}).code == 1);
    CHECK(taut::render::read_png(folder / "diff.png").width == 64);
    CHECK(diff("square.png", {"--out", folder.str("square.png/diff.png")}).code == 4);
  }
}
