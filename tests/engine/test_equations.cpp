#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "engine/methods/all_methods.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/methods/families.hpp"
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

/// Broken string literals are joined.
const std::string& test_sources() {
  static const std::string text = [] {
    std::string all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "tests/engine"))
      if (entry.path().extension() == ".cpp") all += text_of(entry.path());
    return std::regex_replace(all, std::regex("\"\\s*\n\\s*\""), "");
  }();
  return text;
}

/// Ignores comments and calls.
bool declares(const std::string& header, const std::string& name) {
  const std::regex declaration("(^|\n)(?! *//)[^\n=]*[\\w>&] (\\w+<[^\n]*>::)?" + name +
                               " *[({]|(struct|class) " + name + "\\b");
  return std::regex_search(header, declaration);
}

template <class F, class Constants>
void check_constants(const F& method, std::vector<ConstantRow<Constants>> (*rows_of)(const F&, int)) {
  CAPTURE(std::string(method.name));
  const std::vector<ConstantRow<Constants>> rows = rows_of(method, 2);
  for (const ConstantRow<Constants>& one : rows) {
    CAPTURE(std::string(one.constant.name));
    Settings settings;
    settings.constants[std::string(one.constant.name)] = 0.75;
    taut::Constants all;
    all.dp = 2;
    const Constants c = constants_of(rows, all, constant_values(method, 2, all.dp, settings));
    for (const ConstantRow<Constants>& other : rows) {
      const double value = &other == &one ? 0.75 : other.constant.value;
      CHECK(c.*other.member == value * (other.constant.name == "h" ? all.dp : 1));
    }
  }
}
template <const auto&... M, class Rows>
void check_constants(MethodList<M...>, const Rows& rows_of) {
  (check_constants(M, rows_of), ...);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("equations: every term names a source, an existing function and an existing test") {
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

  TEST_CASE("equations: every citation belongs to a term of a method that cites it") {
    for (const MethodInfo& method : methods()) {
      for (const Citation& citation : method.formulation.citations) {
        const auto has = [&](const MethodInfo& m) {
          return m.formulation.citations.data() == method.formulation.citations.data() &&
                 std::ranges::find(m.terms, citation.what, &TermInfo::what) != m.terms.end();
        };
        CAPTURE(std::string(citation.what));
        CHECK(std::ranges::any_of(methods(), has));
      }
    }
  }

  TEST_CASE("constants: each setting sets its own member, and omitted settings have their default") {
    check_constants(ul_split::Methods{}, ul_split::constants);
    check_constants(ul_cauchy::Methods{}, ul_cauchy::constants);
    check_constants(bonded::Methods{}, bonded::constants);
    check_constants(tl_displacement::Methods{}, tl_displacement::constants);
    check_constants(tl_mixed::Methods{}, tl_mixed::constants);
    check_constants(finite_elements::Methods{}, finite_elements::constants);
    Settings stiff;
    stiff.constants["contact_stiffness"] = 0.75;
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const Formulation& m = method.formulation;
      CHECK(constant_values(m, 2, 2, stiff).at("contact_stiffness") == 0.75);
      CHECK(constant_values(m, 2, 2, {}).at("contact_stiffness") == m.contact_stiffness);
    }
    const auto spatial = method_constants(find_method("enog")->formulation, 3);
    CHECK(std::ranges::find(spatial, "zeta", &MethodConstant::name)->value == Approx(4.2));
  }

  TEST_CASE("tests: no name has a semicolon, because CMake would split it and run nothing") {
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

  TEST_CASE("equations: a missing function or test is detected") {
    CHECK(declares("double f(double x) {", "f"));
    CHECK_FALSE(declares("/// see f(x) of another\ndouble g(double x) {", "f"));
    CHECK_FALSE(declares("double fall(double x) {", "f"));
    CHECK_FALSE(declares("  double y = f(x);", "f"));
    CHECK(test_sources().find("TEST_CASE(\"equations: every term names") != std::string::npos);
    CHECK(test_sources().find("TEST_CASE(\"equations: there is no such test") == std::string::npos);
  }
}

}  // namespace of_this_file
