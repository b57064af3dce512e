#include <algorithm>
#include <regex>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/structure/files.hpp"

using namespace taut::test;

namespace {

/// Lines of a comment without their slashes.
using Block = Texts;

std::vector<Block> comment_blocks(const std::string& text) {
  static const std::regex comment(R"(\s*///?<?\s?(.*))");
  std::vector<Block> blocks{{}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch words;
    if (std::regex_match(line, words, comment))
      blocks.back().push_back(words[1]);
    else if (!blocks.back().empty())
      blocks.emplace_back();
  }
  if (blocks.back().empty()) blocks.pop_back();
  return blocks;
}

Texts test_names(const std::string& text) {
  static const std::regex name(R"re((?:TEST_CASE|SUBCASE)\(\s*"((?:[^"\\]|\\.)*))re");
  Texts names;
  for (std::sregex_iterator found(text.begin(), text.end(), name), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}

/// A prefix such as "judge: " is skipped.
bool lacks_subject(const std::string& text) {
  static const std::regex opening(R"(([a-z0-9 -]+: )?(What|Of|Who|Whose|Whom|what|of|who|whose|whom)\b.*)");
  return std::regex_match(text, opening);
}

/// Numbers of the lines that end inside a phrase of a literal; raw literals of several lines are skipped.
std::vector<int> broken_phrases(const std::string& text) {
  static const std::regex first(R"re(.*"\s*(//.*)?)re"), second(R"re(\s*R?".*)re"), raw(R"re(R"(\w*)\()re"),
      whole(R"re(.*(\\n|[.,;:!?)])( |'|\\")*"\s*(//.*)?)re");
  std::vector<int> found;
  std::istringstream lines(text);
  std::string line, last, end;
  for (int number = 0; std::getline(lines, line); ++number, last = line) {
    if (end.empty() && std::regex_match(last, first) && std::regex_match(line, second) &&
        !std::regex_match(last, whole))
      found.push_back(number);
    std::smatch opening;
    if (end.empty() && std::regex_search(line, opening, raw)) end = ")" + opening.str(1) + "\"";
    if (line.find(end) != std::string::npos) end.clear();
  }
  return found;
}

bool is_generated(const std::string& document) {
  return document == "scenes/LANGUAGE.md" || document.starts_with("scenes/studies/results/");
}

bool is_running_text(const std::string& line) {
  return !line.starts_with('|') && !line.starts_with("    ") && line.find("](") == std::string::npos;
}

}  // namespace

TEST_SUITE("structure") {
  TEST_CASE(
      "prose: the helpers find missing subjects, comment blocks, test names, broken literals and running text") {
    CHECK(lacks_subject("What holds them does no work."));
    CHECK(lacks_subject("judge: what heals has been broken"));
    CHECK_FALSE(lacks_subject("Clamped particles do no work."));
    CHECK_FALSE(lacks_subject("Office hours"));
    const std::vector<Block> blocks =
        comment_blocks("int a;  // first\n/// One.\n/// Two.\nint b;\n// Three.\n");
    CHECK(blocks == std::vector<Block>{{"One.", "Two."}, {"Three."}});
    CHECK(test_names("TEST_CASE(\n      \"a \\\"name\\\" here\" \"rest\") SUBCASE(\"b\")") ==
          Texts{"a \\\"name\\\" here", "b"});
    const std::string broken =
        "a(\"one \"  // word\n  \"phrase, \"\n  \"clause\\n\"\n  R\"(b = \"c\"\n  \"d\")\");\n";
    CHECK(broken_phrases(broken) == std::vector<int>{1});
    CHECK(is_running_text("plain"));
    CHECK_FALSE(is_running_text("| cell |"));
  }

  TEST_CASE(
      "prose: comment blocks and test names never open with what, of or who, and blocks have at most 15 lines") {
    constexpr std::size_t most_lines = 15;
    for (const std::string part : {"engine", "render", "cli", "tests"})
      for (const std::string& source : sources_below(top / part)) {
        CAPTURE(part);
        CAPTURE(source);
        const std::string text = text_of(top / part / source);
        for (const Block& block : comment_blocks(text)) {
          CAPTURE(block.front());
          CHECK(block.size() <= most_lines);
          CHECK_FALSE(lacks_subject(block.front()));
        }
        for (const std::string& name : test_names(text)) {
          CAPTURE(name);
          CHECK_FALSE(lacks_subject(name));
        }
      }
  }

  TEST_CASE(
      "prose: string literals continue on the next line only after a line break, a sentence or a clause") {
    for (const std::string part : {"engine", "render", "cli", "tests"})
      for (const std::string& source : sources_below(top / part))
        for (const int line : broken_phrases(text_of(top / part / source)))
          FAIL_CHECK((part + "/" + source + ":" + std::to_string(line)));
  }

  TEST_CASE("prose: running text that is not generated has at most 120 columns") {
    constexpr std::size_t most_columns = 120;
    for (const std::string& document : files_below(top, {".md"})) {
      if (is_generated(document)) continue;
      CAPTURE(document);
      std::istringstream lines(text_of(top / document));
      bool is_code = false;
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) is_code = !is_code;
        if (is_code || !is_running_text(line)) continue;
        CAPTURE(line);
        CHECK(columns_of(line) <= most_columns);
      }
    }
  }
}
