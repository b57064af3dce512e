#include <fstream>

#include <doctest/doctest.h>

#include "cli/scene/reference_table.hpp"
#include "cli/scene/scene_file.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

std::string with_references(const std::string& references) {
  const std::string old = "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nvalues = { peak = 3 }\n";
  return replaced(replaced(small_scene, "of = \"maximum\"", "of = \"at_rest\""), old, references);
}

std::string reference(const std::string& name, const std::string& keys) {
  return "[[reference]]\nlaw = \"neo_hookean\"\nname = \"" + name + "\"\n" + keys + "\n";
}

std::string chosen(const std::string& text, const std::string& method, const std::string& v0) {
  const auto references = read_text(text, {{"method", method}, {"v0", v0}}).scene.references;
  return references.contains("neo_hookean") ? references.at("neo_hookean").name_for("peak") : "none";
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("references: a table along a line needs a line with one time, and must cover the whole line") {
    const auto with = [](const std::string& times, const std::string& rows) {
      std::ofstream(scratch_folder() / "line.csv") << "s,p\n" << rows;
      const std::string line =
          "[[line]]\nname = \"cut\"\nbody = \"block\"\nfield = \"pressure\"\nfrom = [0, 0.5]\nto = [2, 0.5]\n"
          "points = 5\ntimes = " +
          times + "\n[[measure]]\nname = \"error\"\nof = \"line_rmse\"\nline = \"cut\"\n";
      return with_references(
          line + reference("a table", "tables = { error = { file = \"line.csv\", column = \"p\" } }"));
    };
    CHECK_NOTHROW(read_text(with("[1]", "0,1\n2,3\n")));
    CHECK_THROWS_WITH_AS(read_text(with("[1, 2]", "0,1\n2,3\n")),
                         doctest::Contains("a table must be of one time, but the line 'cut' has 2"),
                         SceneError);
    for (const char* rows : {"0,1\n1.9,3\n", "0.1,1\n2,3\n"})
      CHECK_THROWS_WITH_AS(read_text(with("[1]", rows)), doctest::Contains("must go from s = 0 to 2 m"),
                           SceneError);
  }

  TEST_CASE("references: a measure takes only the kinds of reference that it can use") {
    const std::string rmse = "[[measure]]\nname = \"off\"\nof = \"rmse\"\nprobe = \"tip\"\n";
    CHECK_THROWS_WITH_AS(
        read_text(with_references(rmse + reference("number", "values = { off = 0.1 }"))),
        doctest::Contains("the measure 'off' cannot have a value; give a table or a solution"), SceneError);
    CHECK_NOTHROW(read_text(with_references(rmse + reference("curve", "solutions = { off = \"sin(t)\" }"))));
    CHECK_THROWS_AS(
        read_text(with_references(rmse + reference("place", "solutions = { off = \"sin(t) + x\" }"))),
        SceneError);
  }

  TEST_CASE("references: the checksum of a scene changes with the contents of its tables") {
    const auto checksum_with = [](const std::string& rows) {
      std::ofstream(scratch_folder() / "tip.csv") << "t,tip\n" << rows;
      const std::string measure =
          "[[measure]]\nname = \"error\"\nof = \"rmse\"\nprobe = \"tip\"\nunit = \"m\"\n";
      return file_checksum(read_text(with_references(
          measure + reference("a table", "tables = { error = { file = \"tip.csv\", column = \"tip\" } }"))));
    };
    const std::string before = checksum_with("0,1\n2,3\n");
    CHECK(before.size() == 16);
    CHECK(checksum_with("0,1\n2,4\n") != before);
    CHECK(checksum_with("0,1\n2,3\n") == before);
    CHECK(file_checksum(read_text(small_scene)).empty());
  }

  TEST_CASE(
      "references: paths of tables are relative to a run folder, even if its first folder does not exist") {
    std::ofstream(scratch_folder() / "tip.csv") << "t,tip\n0,1\n2,3\n";
    const std::string measure =
        "[[measure]]\nname = \"error\"\nof = \"rmse\"\nprobe = \"tip\"\nunit = \"m\"\n";
    const SceneFile scene = read_text(with_references(
        measure + reference("a table", "tables = { error = { file = \"tip.csv\", column = \"tip\" } }")));
    REQUIRE_FALSE(std::filesystem::exists("no-such-folder"));
    const std::string absolute = resolved_text(scene, std::filesystem::absolute("no-such-folder/run"));
    CHECK(absolute.find("tip.csv\"") != std::string::npos);
    CHECK(resolved_text(scene, "no-such-folder/run") == absolute);
  }

  TEST_CASE(
      "references: a method's reference comes first, then a reference for the parameters, then a general reference") {
    const std::string any = reference("any", "solutions = { peak = \"v0\" }");
    const std::string these = reference("these", "values = { peak = 3 }");
    const std::string own = reference("own", "methods = [\"icb\", \"tl\"]\nsolutions = { peak = \"2*v0\" }");
    for (const std::string& text : {with_references(any + these + own), with_references(own + these + any)}) {
      CHECK(chosen(text, "enog", "0.06") == "these");
      CHECK(chosen(text, "enog", "0.1") == "any");
      CHECK(chosen(text, "icb", "0.06") == "own");
      CHECK(chosen(text, "tl", "0.1") == "own");
    }
    CHECK(chosen(with_references(own), "enog", "0.1") == "none");
    CHECK_THROWS_WITH_AS(read_text(with_references(any + any)), doctest::Contains("two references"),
                         SceneError);
    const std::string more = "[[measure]]\nname = \"least\"\nof = \"minimum\"\nprobe = \"tip\"\n";
    const Reference both =
        read_text(with_references(more + any + reference("other", "values = { least = 1 }")))
            .scene.references.at("neo_hookean");
    CHECK(both.name_for("peak") == "any");
    CHECK(both.name_for("least") == "other");
    CHECK(both.solution.contains("peak"));
    CHECK(both.value.at("least") == 1);
    // a solution can use the constants of the only material
    const std::string modulus =
        reference("modulus", "let = { m = \"E/(1 - nu^2)\" }\nsolutions = { peak = \"m/E\" }");
    const Reference named = read_text(with_references(modulus)).scene.references.at("neo_hookean");
    const double nu = read_text(with_references(any)).scene.materials.at(0).poisson_ratio;
    CHECK(named.solution.at("peak").at(0)({}, 2) == relative(1 / (1 - nu * nu)));
    const Reference found = read_text(with_references(any)).scene.references.at("neo_hookean");
    CHECK(found.solution.at("peak").at(0)({}, 2) == 0.06);
  }
}
