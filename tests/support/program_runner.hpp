#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command_line/program.hpp"
#include "cli/commands/commands.hpp"
#include "tests/support/files.hpp"

namespace taut::test {

using namespace cli;

struct Outcome {
  int code;
  std::string out, err;
};

inline Outcome call(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = cli::run_program(cli::commands(), arguments, {out, err});
  return {code, out.str(), err.str()};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline nlohmann::ordered_json json_of(const fs::path& path) {
  return nlohmann::ordered_json::parse(text_of(path));
}

/// `pull` stretches the discs along y.
inline std::string write_tiny_scene(const TemporaryFolder& folder) {
  std::ofstream(folder / "discs.toml") << R"(
title = "Two discs"
source = "none"
dim = 2
spacing = 0.002
until = 0.002
method = "enog"
[parameters]
speed = { value = 2.0, unit = "m/s", min = 0, help = "of each disc" }
pull = { value = 0, unit = "1/s", help = "rate of stretching along y" }
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "left"
shape = { type = "disc", centre = [-0.011, 0], radius = 0.01 }
material = "rubber"
velocity = ["speed", "pull*y"]
[[body]]
name = "right"
shape = { type = "disc", centre = [0.011, 0], radius = 0.01 }
material = "rubber"
velocity = ["-speed", "pull*y"]
[[probe]]
name = "gap"
of = "gap"
bodies = ["left", "right"]
[[measure]]
name = "touch_time"
of = "first_below"
probe = "gap"
threshold = 0
unit = "s"
[render]
color = "speed"
range = [0, 4]
view = [-0.03, 0.03, -0.02, 0.02]
size = [160, 120]
frames = 4
)";
  return folder.str("discs.toml");
}

/// Measure of the tiny scene with a reference in a table with the columns t and gap.
inline std::string reference_of_gap(const std::string& table) {
  return R"(
[[measure]]
name = "gap_rmse"
of = "rmse"
probe = "gap"
unit = "m"
[[reference]]
law = "2d_deviator"
name = "made up"
tables = { gap_rmse = { file = ")" +
         table + R"(", column = "gap" } }
)";
}

inline std::vector<std::string> tiny_run(const TemporaryFolder& folder, const std::string& out,
                                         const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{
      "run", write_tiny_scene(folder), "--out", folder.str(out), "--threads", "1", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace taut::test
