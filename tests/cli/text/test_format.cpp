#include <doctest/doctest.h>

#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"

using namespace taut::cli;

TEST_SUITE("unit") {
  TEST_CASE("a table wider than the terminal wraps its widest column") {
    const std::vector<std::vector<std::string>> rows{
        {"og", "one two three four five six seven eight", "source"}, {"enog", "short", "Zhang2024"}};
    CHECK(in_columns(rows) ==
          "  og    one two three four five six seven eight  source\n"
          "  enog  short                                    Zhang2024\n");
    CHECK(in_columns(rows, 2, 45) ==
          "  og    one two three four five     source\n"
          "        six seven eight\n"
          "  enog  short                       Zhang2024\n");
    CHECK(in_columns(rows, 2, 200) == in_columns(rows));
  }

  TEST_CASE("text is wrapped at blanks, and a long word is not broken") {
    CHECK(wrapped("one two three", 2, 9) == "  one two\n  three");
    CHECK(wrapped("incompressibility", 0, 5) == "incompressibility");
    CHECK(wrapped("", 2, 9) == "  ");
  }

  TEST_CASE("a table of Markdown escapes bars and joins lines") {
    CHECK(markdown_table({{"a", "b"}, {"x|y", "1\n2"}}) == "| a | b |\n| --- | --- |\n| x\\|y | 1 2 |\n");
  }

  TEST_CASE("numbers are shown with at most six significant digits") {
    CHECK(six_digits(-0.00917469025591435) == "-0.00917469");
    CHECK(six_digits(2) == "2");
  }
}
