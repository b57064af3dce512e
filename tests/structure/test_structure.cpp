#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/structure/files.hpp"
#include "tests/structure/room_table.hpp"

using namespace taut::test;

namespace {

namespace fs = std::filesystem;
const Texts parts = {"engine", "render", "cli"};

RoomTable rooms_of(const std::string& part) {
  const auto table = RoomTable::read(text_of(top / part / "README.md"));
  REQUIRE_MESSAGE(table, part << "/README.md has no table of rooms");
  return *table;
}

Texts includes_of(const fs::path& source, const std::string& part) {
  const std::string before = "#include \"" + part + "/";
  std::istringstream lines(text_of(source));
  Texts included;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(before))
      included.push_back(line.substr(before.size(), line.find('"', before.size()) - before.size()));
  return included;
}

std::size_t lines_of(const fs::path& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

std::size_t widest_line(const fs::path& file) {
  std::istringstream lines(text_of(file));
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, columns_of(line));
  return widest;
}

/// Link targets, and backticked paths whose first folder exists; not out/, which runs of users fill.
std::set<std::string> named_paths(const std::string& text, const fs::path& folder) {
  std::set<std::string> paths;
  static const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))"),
      path(R"((\./)?([A-Za-z0-9_.-]+)/[A-Za-z0-9_./-]*)");
  for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found)
    paths.insert((*found)[1]);
  std::smatch parts_of_path;
  for (const std::string& word : in_backticks(text))
    if (std::regex_match(word, parts_of_path, path) && parts_of_path[2] != "out" &&
        (fs::exists(folder / parts_of_path[2].str()) || fs::exists(top / parts_of_path[2].str())))
      paths.insert(word);
  return paths;
}

}  // namespace

TEST_SUITE("structure") {
  TEST_CASE("a table of rooms is read correctly") {
    const auto table = RoomTable::read(
        "text\n| a | b |\n|---|---|\n| `x` | `y` |\n\n| room | may include |\n|---|---|\n"
        "| `error` `a.hpp` | |\n| `core/` | |\n| `terms/` `laws/` | `core/` |\n"
        "| `core/deep/` | all above |\n");
    REQUIRE(table);
    REQUIRE(table->rows().size() == 4);
    CHECK(table->room_of("core/deep/tile.hpp") == "core/deep/");
    CHECK(table->room_of("core/tile.hpp") == "core/");
    CHECK(table->room_of("error.hpp") == "error");
    CHECK(table->room_of("errors.hpp").empty());
    CHECK(table->allows("terms/", "core/"));
    CHECK(table->allows("core/deep/", "laws/"));
    CHECK(table->allows("a.hpp", "error"));
    CHECK_FALSE(table->allows("terms/", "laws/"));
    CHECK_FALSE(table->allows("terms/", "error"));
    CHECK_FALSE(RoomTable::read("| room | holds |\n|---|---|\n| `a/` | b |\n"));
  }

  TEST_CASE("every room includes only the rooms that its table allows, and allowed rooms are in rows above") {
    for (const std::string& part : parts) {
      const RoomTable table = rooms_of(part);
      for (std::size_t row = 0; row < table.rows().size(); ++row) {
        for (const std::string& name : table.rows()[row].names) {
          CAPTURE(name);
          CHECK((fs::exists(top / part / name) || fs::exists(top / part / (name + ".hpp")) ||
                 fs::exists(top / part / (name + ".cpp"))));
        }
        for (const std::string& below : table.rows()[row].may_include) {
          CAPTURE(below);
          CHECK(table.row_of(below) < row);
        }
      }
      for (const std::string& source : sources_below(top / part)) {
        CAPTURE(part);
        CAPTURE(source);
        const std::string room = table.room_of(source);
        REQUIRE_FALSE(room.empty());
        for (const std::string& included : includes_of(top / part / source, part)) {
          CAPTURE(included);
          const std::string other = table.room_of(included);
          REQUIRE_FALSE(other.empty());
          CHECK(table.allows(room, other));
        }
      }
    }
  }

  TEST_CASE("parts include only lower parts") {
    for (std::size_t low = 0; low < parts.size(); ++low)
      for (std::size_t high = low + 1; high < parts.size(); ++high)
        for (const std::string& source : sources_below(top / parts[low])) {
          CAPTURE(source);
          CHECK(includes_of(top / parts[low] / source, parts[high]).empty());
        }
  }

  TEST_CASE("each third-party header that takes seconds to compile is included by one source") {
    for (const std::string header : {"<CLI/CLI.hpp>", "<nlohmann/json.hpp>", "<toml++/toml.h>"}) {
      Texts users;
      for (const std::string& part : parts)
        for (const std::string& source : sources_below(top / part))
          if (text_of(top / part / source).find("#include " + header) != std::string::npos)
            users.push_back(source);
      CAPTURE(header);
      REQUIRE(users.size() == 1);
      CHECK(users.front().ends_with(".cpp"));
    }
  }

  TEST_CASE("rooms, files and lines stay within their limits") {
    constexpr std::size_t most_units = 20, most_rooms = 15, most_lines = 500;
    constexpr std::size_t most_columns = 122;            // clang-format: 110; raw strings need more
    std::map<std::string, std::set<std::string>> units;  // header and source are one unit
    std::set<std::string> rooms_of_cli;
    for (const std::string part : {"engine", "render", "cli", "tests"})
      for (const std::string& source : sources_below(top / part)) {
        const fs::path path = fs::path(part) / source;
        CAPTURE(path.string());
        CHECK(lines_of(top / path) <= most_lines);
        if (part != "tests") CHECK(widest_line(top / path) <= most_columns);
        units[path.parent_path().string()].insert(path.stem().string());
        if (part == "cli" && path.parent_path() != "cli") rooms_of_cli.insert(path.parent_path().string());
      }
    for (const auto& [room, names] : units) {
      const auto& room_now = room;
      CAPTURE(room_now);
      CHECK(names.size() <= most_units);
    }
    CHECK(rooms_of_cli.size() <= most_rooms);
  }

  TEST_CASE("tests do not use doctest's own Approx, which holds for any two small numbers") {
    const std::string own =
        "doctest::"
        "Approx";
    for (const std::string& source : sources_below(top / "tests")) {
      if (source == "support/relative.hpp") continue;
      CAPTURE(source);
      CHECK(text_of(top / "tests" / source).find(own) == std::string::npos);
    }
  }

  TEST_CASE("every path that the documents link to or name exists") {
    const Texts texts = files_below(top, {".md"});
    REQUIRE_FALSE(texts.empty());
    for (const std::string& text : texts) {
      const fs::path folder = (top / text).parent_path();
      for (const std::string& path : named_paths(text_of(top / text), folder)) {
        CAPTURE(text);
        CAPTURE(path);
        CHECK((fs::exists(folder / path) || fs::exists(top / path)));
      }
    }
  }

  TEST_CASE("every test that PROMISES.md links to exists under that name") {
    const fs::path page = top / "cli/PROMISES.md";
    const std::string text = text_of(page);
    static const std::regex link(R"(\[([^\]`]+)\]\(([^)]+\.cpp)\))"), broken(R"("\s*\n\s*")");
    int tests = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found, ++tests) {
      const std::string name = (*found)[1], file = (*found)[2];
      CAPTURE(name);
      CAPTURE(file);
      CHECK(std::regex_replace(text_of(page.parent_path() / file), broken, "").find('"' + name + "\")") !=
            std::string::npos);
    }
    CHECK(tests > 20);
  }
}
