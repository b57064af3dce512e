#pragma once

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sys/wait.h>

#include <doctest/doctest.h>

#include "tests/support/program_runner.hpp"

namespace taut::test {

using Texts = std::vector<std::string>;

inline std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

/// Started by sh because a process with threads must not fork.
inline Outcome program(const Texts& arguments, const fs::path& folder = ".") {
  const TemporaryFolder streams;
  std::string command = "cd " + shell_word(folder.string()) + " && " TAUT_BINARY_DIR "/taut";
  for (const std::string& argument : arguments) command += " " + shell_word(argument);
  const int status = std::system((command + " >" + streams.str("out") + " 2>" + streams.str("err")).c_str());
  return {WEXITSTATUS(status), text_of(streams / "out"), text_of(streams / "err")};
}

inline std::vector<std::string> tiny_sweep(const TemporaryFolder& folder, const std::string& out,
                                           const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"sweep", write_tiny_scene(folder), "--out", folder.str(out), "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Without the columns that vary between repetitions.
inline std::vector<std::string> results(const fs::path& folder) {
  std::vector<std::string> lines = lines_of(folder / "results.csv");
  REQUIRE(lines.size() > 1);
  const std::size_t first_time = lines[0].find(",threads,");
  const auto columns = std::count(lines[0].begin(), lines[0].begin() + static_cast<long>(first_time), ',');
  for (std::string& line : lines) {
    std::size_t end = 0;
    for (long k = 0; k <= columns && end != std::string::npos; ++k) end = line.find(',', end + (k > 0));
    line.resize(std::min(end, line.size()));
  }
  return lines;
}

inline std::vector<std::string> statuses(const fs::path& folder) {
  std::vector<std::string> all;
  const auto json = json_of(folder / "results.json");
  for (const auto& run : json["runs"]) all.push_back(run["status"]);
  return all;
}

/// End times of finished runs, by folder.
inline std::map<std::string, fs::file_time_type> ends(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && fs::exists(entry.path() / "run.json") &&
        json_of(entry.path() / "run.json")["status"] == "finished")
      times[entry.path().filename().string()] = fs::last_write_time(entry.path() / "run.json");
  return times;
}

}  // namespace taut::test
