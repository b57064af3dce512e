#include <cstdlib>

#include <doctest/doctest.h>

#include "cli/scene/shipped.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

/// Reports the test as skipped if it returns false.
bool jsonschema_is_there() {
  const bool there = std::system("/usr/bin/python3 -c 'import tomllib, jsonschema' 2>/dev/null") == 0;
  if (!there) MESSAGE("skipped: there is no jsonschema for Python (Debian's package python3-jsonschema)");
  return there;
}

/// For each file "valid" or the keys that the schema refuses.
Texts verdicts(const std::string& kind, const std::vector<fs::path>& files) {
  const TemporaryFolder folder;
  std::ofstream(folder / "schema.json") << call({"describe", kind, "--schema"}).out;
  std::string command = "/usr/bin/python3 " TAUT_SOURCE_DIR "/tests/cli/language/read_schema.py '" +
                        folder.str("schema.json") + "'";
  for (const fs::path& file : files) command += " '" + file.string() + "'";
  CHECK(std::system((command + " >'" + folder.str("verdicts") + "'").c_str()) == 0);
  return lines_of(folder / "verdicts");
}

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

void check_valid(const std::string& kind, const std::vector<fs::path>& files) {
  const Texts found = verdicts(kind, files);
  REQUIRE(found.size() == files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    CAPTURE(files[k]);
    CHECK(found[k] == "valid");
  }
}

std::string refused_key(const std::string& text) {
  try {
    read_text(text);
  } catch (const taut::SceneError& error) {
    return error.key;
  }
  return "valid";
}

const fs::path scenes = fs::path(TAUT_SOURCE_DIR) / "scenes";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "schema: shipped scenes, studies, claims and suites are valid, and scenes also with every default") {
    if (!jsonschema_is_there()) return;
    std::vector<fs::path> files = toml_files(scenes);
    CHECK(files.size() > 30);
    const TemporaryFolder folder;
    for (const fs::path& file : std::vector(files)) {
      files.push_back(folder / file.filename().string());
      std::ofstream(files.back()) << resolved_text(read_scene(file), folder.path());
    }
    for (const char* folder_of_scenes : {"gallery", "studies/known-answers"})
      for (const fs::path& file : toml_files(scenes / folder_of_scenes)) files.push_back(file);
    REQUIRE(call(tiny_run(folder, "run", {"--no-render"})).code == 0);
    files.push_back(folder / "run/scene.toml");
    check_valid("scene-file", files);
    check_valid("sweep-file", toml_files(scenes / "studies"));
    check_valid("claim-file", toml_files(scenes / "papers"));
    check_valid("suite-file", toml_files(scenes / "suites"));
  }

  TEST_CASE("schema: taut and the schema refuse invalid scenes at the same key") {
    if (!jsonschema_is_there()) return;
    const fs::path list = fs::path(TAUT_SOURCE_DIR) / "tests/cli/language/wrong_scenes.toml";
    TomlValue wrong = parse_toml(text_of(list), list.string());
    const TemporaryFolder folder;
    std::vector<fs::path> files;
    Texts keys;
    for (const TomlValue& entry : wrong.find("wrong")->value.items) {
      const auto text = [&](const char* key) { return entry.find(key)->value.text; };
      CAPTURE(text("new"));
      const std::string scene = replaced(small_scene, text("old"), text("new"));
      CHECK(refused_key(scene) == text("key"));
      keys.push_back(text("key"));
      files.push_back(folder / (std::to_string(files.size()) + ".toml"));
      std::ofstream(files.back()) << scene;
    }
    CHECK(keys.size() > 20);
    CHECK(verdicts("scene-file", files) == keys);
  }

  TEST_CASE("schema: invalid sweeps are refused") {
    if (!jsonschema_is_there()) return;
    const TemporaryFolder folder;
    const auto verdict = [&](const std::string& text) {
      std::ofstream(folder / "sweep.toml") << "scene = 'colliding-rings'\n" + text;
      return verdicts("sweep-file", {folder / "sweep.toml"});
    };
    CHECK(verdict("grid.v0 = [0.1]\ngrid.'method.zeta' = '1, 2'") == Texts{"valid"});
    CHECK(verdict("grid.v0 = []") == Texts{"grid.v0"});
    CHECK(verdict("[grid]") == Texts{"grid"});
    CHECK(verdict("grid.v0 = 1\nchart.cost = 'hours'") == Texts{"chart.cost"});
    CHECK(verdict("grid.v0 = 1\nchrt.cost = 'steps'") == Texts{"chrt"});
    CHECK(verdict("") == Texts{"the file"});
    CHECK(verdict("grid.v0 = 1\nrow = [{ v0 = 2 }]") == Texts{"valid"});
  }

  TEST_CASE("schema: invalid suites are refused") {
    if (!jsonschema_is_there()) return;
    const TemporaryFolder folder;
    const auto verdict = [&](const std::string& text) {
      std::ofstream(folder / "suite.toml") << text;
      return verdicts("suite-file", {folder / "suite.toml"});
    };
    const std::string entry = "[[entry]]\nname = 'a'\nscene = 'colliding-rings'\n";
    CHECK(verdict("fail = 2\nset = { v0 = 0.1 }\n" + entry + "render = { color = 'speed' }") ==
          Texts{"valid"});
    CHECK(verdict(entry + "[[entry]]\nname = 'b'\ndiffers_from = 'a'") == Texts{"valid"});
    CHECK(verdict("title = 'none'") != Texts{"valid"});
    CHECK(verdict(entry + "differs_from = 'a'") != Texts{"valid"});
    CHECK(verdict(entry + "fail = -2") != Texts{"valid"});
    CHECK(verdict(entry + "render = { colour = 'speed' }") != Texts{"valid"});
    CHECK(verdict(entry + "method = 'ogg'") != Texts{"valid"});
  }

  TEST_CASE("schema: the scene schema contains descriptions, defaults, bounds and required keys") {
    const auto schema = nlohmann::ordered_json::parse(call({"describe", "scene-file", "--schema"}).out);
    const auto& keys = schema["properties"];
    CHECK(keys["method"]["default"] == "oenog");
    CHECK(keys["dim"]["default"] == 2);
    CHECK(keys["spacing"]["exclusiveMinimum"] == 0);
    CHECK(contains(keys["history"]["description"], "Default: until/1000"));
    CHECK(keys["render"]["properties"]["frames"]["maximum"] == 1000000);
    CHECK(keys["reference"]["items"]["required"] == nlohmann::ordered_json{"law", "name"});
    const Outcome other = call({"describe", "body", "--schema"});
    CHECK(other.code == 2);
    CHECK(contains(
        other.err,
        "--schema cannot describe 'body'; it describes scene-file, sweep-file, claim-file and suite-file"));
  }

  TEST_CASE("schema: a scene can name its schema in a comment") {
    CHECK_NOTHROW(read_text("#:schema ./scene.schema.json\n" + small_scene));
  }
}
