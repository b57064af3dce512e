#include <cstdlib>

#include <doctest/doctest.h>

#include "cli/claims/claim_file.hpp"
#include "cli/language/reference.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/sections.hpp"
#include "cli/sweep/suite_file.hpp"
#include "cli/sweep/sweep_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

bool is_top_level(const Section& section) {
  return section.header.empty() || section.header.starts_with('[');
}

/// Examples of all top-level sections except `without`.
std::string whole_file(std::span<const Section> sections, std::string_view without = "") {
  std::string text;
  for (const Section& section : sections)
    if (is_top_level(section) && section.name != without) text.append(example_of(section.name)) += "\n";
  return text;
}

/// Replaces `key` by `lines` in the first section with this `header`.
std::string with_key(std::string text, std::string_view header, std::string_view key,
                     std::string_view lines) {
  const std::size_t begin = text.find(header) + header.size() + 1;
  const std::size_t end = text.find("[[", begin);
  if (const std::size_t old = text.find("\n" + std::string(key) + " = ", begin); old < end)
    text.erase(old + 1, text.find('\n', old + 1) - old);
  return text.insert(begin, lines);
}

std::string scene_of_shape(const ShapeKind& kind) {
  return "dim = " + std::to_string(kind.dim == 0 ? 2 : kind.dim) +
         "\nspacing = 0.002\nuntil = 1\n[material.rubber]\ndensity = 1200\nyoungs_modulus = 1e7\n"
         "poisson_ratio = 0.4\n[[body]]\nname = \"it\"\nmaterial = \"rubber\"\n" +
         std::string(example_of(kind.name));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("language: the section examples form one scene, and every other example is a key of it") {
    const std::string whole = whole_file(scene_sections());
    CAPTURE(whole);
    CHECK_NOTHROW(read_text(whole));
    std::filesystem::create_directory_symlink(std::filesystem::path(TAUT_SOURCE_DIR) / "scenes/references",
                                              scratch_folder() / "references");
    for (const Section& section : scene_sections()) {
      CAPTURE(section.name);
      CHECK_FALSE(example_of(section.name).empty());
      if (is_top_level(section)) continue;
      const char* const header = section.name == "tables" ? "[[reference]]" : "[[body]]";
      std::string changed = with_key(whole, header, section.name, example_of(section.name));
      if (section.name == "driven") changed = replaced(changed, "abs(x) > 0.05 - 4*dp", "x < -0.05 + 4*dp");
      CAPTURE(changed);
      CHECK_NOTHROW(read_text(changed));
    }
  }

  TEST_CASE("language: the example of every shape except svg, mask and mesh can be read") {
    std::ofstream(scratch_folder() / "places.csv") << "x,y\n0,0\n0.002,0\n0,0.002\n";
    for (const ShapeKind& kind : shape_kinds()) {
      CAPTURE(kind.name);
      REQUIRE_FALSE(example_of(kind.name).empty());
      if (kind.name == "svg" || kind.name == "mask" || kind.name == "mesh") continue;
      CHECK_NOTHROW(read_text(scene_of_shape(kind)));
    }
  }

  TEST_CASE("language: the section examples of a sweep form sweeps") {
    const auto read = [](const std::string& text) {
      const std::filesystem::path path = scratch_folder() / "sweep.toml";
      std::ofstream(path, std::ios::binary) << text;
      return read_sweep(path);
    };
    const std::string set(example_of("set"));
    CHECK(read(set + whole_file(sweep_sections(), "row")).rows.size() == 16);
    CHECK(read(set + whole_file(sweep_sections(), "grid")).rows.size() == 2);
  }

  TEST_CASE("language: the section examples of a claim file form a claim file") {
    const std::filesystem::path path = scratch_folder() / "Monaghan2000.toml";
    std::ofstream(path, std::ios::binary) << whole_file(claim_sections());
    const Paper paper = read_paper(path);
    REQUIRE(paper.claims.size() == 1);
    CHECK(paper.claims.front().name() == "Monaghan2000.fig-6");
    CHECK(paper.claims.front().runs.size() == 2);
  }

  TEST_CASE("language: the section examples of a suite form a suite") {
    const std::filesystem::path path = scratch_folder() / "suite.toml";
    std::ofstream(path, std::ios::binary) << whole_file(suite_sections());
    const SuiteFile suite = read_suite(path);
    REQUIRE(suite.entries.size() == 3);
    CHECK(suite.entries[2].differs_from == "rings");
    CHECK(suite.entries[2].warn == 5);
    CHECK(suite.entries[2].settings.size() == 3);
    CHECK_FALSE(suite.entries[1].warn);
    CHECK(suite.entries[1].fail == 20);
    CHECK(suite.entries[1].drawing.size() == 3);
  }

  TEST_CASE("language: every key has its values and a help text, and every section has a help text") {
    for (const auto& sections : {scene_sections(), sweep_sections(), claim_sections(), suite_sections()})
      for (const Section& section : sections) CHECK_FALSE(section.help.empty());
    const Rows keys = key_rows();
    CHECK(keys.size() > 100);
    for (std::size_t k = 1; k < keys.size(); ++k)
      for (const std::string& cell : keys[k]) {
        CAPTURE(keys[k].front());
        CHECK_FALSE(cell.empty());
      }
  }

  TEST_CASE("language: an unreadable scene file does not hide the others") {
    const TemporaryFolder folder;
    std::ofstream(folder / "pyproject.toml") << "[project]\nname = \"other\"\n";
    ::setenv("TAUT_SCENES", folder.path().c_str(), 1);
    const Outcome listed = call({"list", "scenes"});
    ::unsetenv("TAUT_SCENES");
    CHECK(listed.code == 0);
    CHECK(contains(listed.out, "colliding-rings"));
    CHECK(contains(listed.out, "cannot be read: "));
  }

  TEST_CASE("language: the page in scenes/ equals the generated one") {
    const std::filesystem::path page = std::filesystem::path(TAUT_SOURCE_DIR) / "scenes/LANGUAGE.md";
    if (std::getenv("TAUT_UPDATE_GOLDEN")) std::ofstream(page, std::ios::binary) << language_page();
    CHECK_MESSAGE(taut::test::text_of(page) == language_page(),
                  "the page is out of date; TAUT_UPDATE_GOLDEN=1 cli_tests -tc='language*' rewrites it");
  }

  TEST_CASE("describe explains files, sections and their entries, as text and as JSON") {
    const std::string all = call({"describe", "scene-file"}).out;
    for (const char* part : {"[[body]]", "[render]", "mirror_asymmetry", "first_below", "cofactor_share"})
      CHECK(contains(all, part));
    CHECK(contains(call({"describe", "sweep-file"}).out, "[[row]]"));
    CHECK(contains(call({"describe", "ring"}).out, "aligned"));
    const Outcome turn = call({"describe", "turn"});
    CHECK(contains(turn.out, "a probe"));
    CHECK(contains(turn.out, "a measure"));
    const auto json = nlohmann::ordered_json::parse(call({"describe", "driven", "--json"}).out);
    CHECK(json[0]["rows"][0]["key"] == "where");
    CHECK(json[0]["rows"][0]["default"] == "needed");
    const auto file = nlohmann::ordered_json::parse(call({"describe", "scene-file", "--json"}).out);
    CHECK(file["topics"].size() > 20);
    CHECK(contains(call({"describe", "bdy"}).err, "did you mean 'body'"));
    CHECK(call({"describe", "enog", "--json"}).code == 2);
  }

  TEST_CASE("list prints shapes, probes, measures, laws, contact laws, keys and fields") {
    for (const char* kind : {"shapes", "probes", "measures", "laws", "contacts", "keys", "fields"}) {
      CAPTURE(kind);
      CHECK(nlohmann::ordered_json::parse(call({"list", kind, "--json"}).out).size() > 3);
    }
    CHECK(contains(call({"list", "laws"}).out, "neo-hookean"));
    CHECK(contains(call({"list", "laws"}).out, "2d-deviator"));
  }
}
