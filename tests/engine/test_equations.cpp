#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "engine/families/catalogue.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

const std::filesystem::path source = TAUT_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// All tests of the engine, with strings that are broken over lines put together.
const std::string& test_sources() {
  static const std::string text = [] {
    std::string all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "tests/engine"))
      if (entry.path().extension() == ".cpp") all += text_of(entry.path());
    return std::regex_replace(all, std::regex("\"\\s*\n\\s*\""), "");
  }();
  return text;
}

/// A declaration: after a type, or as a member's definition; not a mention in a comment or a call.
bool declares(const std::string& header, const std::string& name) {
  const std::regex declaration("(^|\n)(?! *//)[^\n=]*[\\w>&] (\\w+<[^\n]*>::)?" + name +
                               " *[({]|(struct|class) " + name + "\\b");
  return std::regex_search(header, declaration);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("equations: every term names a source, a function that is there and a test that is there") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      CHECK(method.terms.size() >= 4);
      for (const TermInfo& term : method.terms) {
        CAPTURE(std::string(term.what));
        CHECK_FALSE(term.formula.empty());
        CHECK_FALSE(term.source.empty());
        const std::string function(term.function);
        const std::size_t colon = function.find(':');
        REQUIRE(colon != std::string::npos);
        CAPTURE(function);
        const auto header = source / "engine" / function.substr(0, colon);
        REQUIRE(std::filesystem::exists(header));
        CHECK(declares(text_of(header), function.substr(colon + 1)));
        CAPTURE(std::string(term.test));
        CHECK(test_sources().find("TEST_CASE(\"" + std::string(term.test) + "\")") != std::string::npos);
      }
    }
  }

  TEST_CASE("equations: every citation of a paper is of a term that its method has") {
    for (const MethodInfo& method : methods()) {
      for (const Citation& citation : method.formulation.citations) {
        // a paper's list serves all its methods of a family
        const auto has = [&](const MethodInfo& m) {
          return m.formulation.citations.data() == method.formulation.citations.data() &&
                 std::ranges::find(m.terms, citation.what, &TermInfo::what) != m.terms.end();
        };
        CAPTURE(std::string(citation.what));
        CHECK(std::ranges::any_of(methods(), has));
      }
    }
  }

  TEST_CASE("constants: each setting reaches a place of its own, and what is left out its default") {
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      for (const MethodConstant& one : method.constants) {
        CAPTURE(std::string(one.name));
        Settings settings;
        settings.constants[std::string(one.name)] = 0.75;
        Constants c;
        c.dp = 2;
        set_constants(c, method.formulation, 2, settings);
        for (const MethodConstant& other : method.constants) {
          const double value = other.name == one.name ? 0.75 : other.value;
          CHECK(c.*other.member == value * (other.name == "h" ? c.dp : 1));
        }
      }
    }
    const auto spatial = method_constants(find_method("enog")->formulation, 3);
    CHECK(std::ranges::find(spatial, "zeta", &MethodConstant::name)->value == Approx(4.2));
  }

  TEST_CASE("tests: no name has a semicolon, at which CMake would break it and run nothing") {
    const std::regex named("TEST_CASE\\(\\s*\"[^\"]*;");
    for (const char* folder : {"tests/engine", "tests/render", "tests/cli", "tests/scenes"}) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
        if (entry.path().extension() != ".cpp") continue;
        CAPTURE(entry.path().string());
        CHECK_FALSE(std::regex_search(text_of(entry.path()), named));
      }
    }
    CHECK(std::regex_search("TEST_CASE(\n  \"a; b\")", named));
  }

  TEST_CASE("equations: a function or a test that is not there is found out") {
    CHECK(declares("double f(double x) {", "f"));
    CHECK_FALSE(declares("/// see f(x) of another\ndouble g(double x) {", "f"));
    CHECK_FALSE(declares("double fall(double x) {", "f"));
    CHECK_FALSE(declares("  double y = f(x);", "f"));
    CHECK(test_sources().find("TEST_CASE(\"equations: every term names") != std::string::npos);
    CHECK(test_sources().find("TEST_CASE(\"equations: there is no such test") == std::string::npos);
  }
}

}  // namespace of_this_file
