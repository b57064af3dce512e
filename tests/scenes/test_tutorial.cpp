#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <sys/wait.h>

#include <doctest/doctest.h>

#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut::cli;
using namespace taut::test;

namespace {

struct PageCommand {
  std::string line;
  int code = 0;
};

/// Files and commands of a page.
class Reader {
 public:
  explicit Reader(const fs::path& page) : text_(text_of(page)) {}

  /// Writes each file and calls `run` with each indented command, in the order of the page.
  template <class Run>
  void follow(const TemporaryFolder& folder, const Run& run) {
    static const std::regex target(R"((Write|Append) this (?:in)?to `([^`]+)`:$)");
    std::istringstream lines(text_);
    std::string line, before;
    for (std::smatch match; std::getline(lines, line);) {
      if (line.starts_with("```toml") && std::regex_search(before, match, target))
        write_block(lines, folder / match[2].str(), match[1] == "Append");
      else if (line.starts_with("    taut "))
        run(command_of(line.substr(4)));
      if (!line.empty()) before = line;
    }
  }

 private:
  static void write_block(std::istringstream& lines, const fs::path& file, bool append) {
    std::ofstream out(file, append ? std::ios::app : std::ios::trunc);
    for (std::string line; std::getline(lines, line) && line != "```";) out << line << '\n';
  }
  static PageCommand command_of(const std::string& line) {
    static const std::regex announced("# exit code ([0-9]+)");
    std::smatch match;
    const std::size_t comment = line.find("  #");
    return {line.substr(0, comment), std::regex_search(line, match, announced) ? std::stoi(match[1]) : 0};
  }

  std::string text_;
};

int shell(const TemporaryFolder& folder, const std::string& command) {
  const std::string line = "cd '" + folder.path().string() + "' && PATH='" TAUT_BINARY_DIR "':\"$PATH\" " +
                           "TAUT_FSYNC=off " + command + " >>out.txt 2>>err.txt";
  return WEXITSTATUS(std::system(line.c_str()));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every indented taut command of the tutorial ends with the announced exit code, else 0") {
    const TemporaryFolder folder;
    int commands = 0;
    Reader(fs::path(TAUT_SOURCE_DIR) / "scenes/TUTORIAL.md").follow(folder, [&](const PageCommand& command) {
      CAPTURE(command.line);
      CHECK(shell(folder, command.line) == command.code);
      ++commands;
    });
    CHECK(commands > 15);
    for (const char* picture : {"tip.png", "panel.png", "chart.png", "map.png"})
      CHECK(fs::exists(folder / picture));
  }

  TEST_CASE("every indented taut command of the front page succeeds") {
    const TemporaryFolder folder;
    int commands = 0;
    Reader(fs::path(TAUT_SOURCE_DIR) / "README.md").follow(folder, [&](const PageCommand& command) {
      static const std::regex scene(R"(^taut (run|sweep) (colliding-rings|oscillating-plate)\b)"),
          balls("--spacing 0.005"), folder_of_run("out/colliding-rings-oenog\\b");
      std::string line = std::regex_replace(command.line, scene, "$& --set spacing=0.005");
      line = std::regex_replace(line, balls, "--spacing 0.01");
      line = std::regex_replace(line, folder_of_run, "$&-spacing=0.005");
      CAPTURE(line);
      CHECK(shell(folder, line) == command.code);
      ++commands;
    });
    CHECK(commands >= 10);
    CHECK(fs::exists(folder / "map.png"));
  }
}

}  // namespace of_this_file
