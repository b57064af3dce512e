#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"

namespace taut::test {

using namespace cli;

inline std::filesystem::path scratch_folder() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("taut_scene_tests_" + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

inline std::filesystem::path write_scene(std::string_view text) {
  const std::filesystem::path path = scratch_folder() / "scene.toml";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

inline SceneFile read_text(std::string_view text, const std::vector<Setting>& settings = {}) {
  return read_scene(write_scene(text), settings);
}

inline std::string replaced(std::string text, std::string_view old_part, std::string_view new_part) {
  const std::size_t at = text.find(old_part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old_part.size(), new_part);
}

inline const std::string small_scene = R"(title = "Small"
spacing = 0.1
until = 2
[parameters]
v0 = { value = 0.06, unit = "c0", help = "speed", min = 0, max = 0.5 }
[material.rubber]
density = 1200
youngs_modulus = 1e7
poisson_ratio = 0.4
[[body]]
name = "block"
shape = { type = "rectangle", low = [0, 0], high = [2, 1] }
material = "rubber"
velocity = ["v0*c0*x", 0]
[[body]]
name = "ring"
shape = { type = "ring", centre = [5, 0], inner = 1, outer = 2 }
material = "rubber"
[[probe]]
name = "tip"
of = "displacement"
body = "block"
at = [2, 0.5]
component = "y"
[[measure]]
name = "peak"
of = "maximum"
probe = "tip"
unit = "m"
[[reference]]
law = "neo_hookean"
name = "made up"
values = { peak = 3 }
[render]
color = "von_mises"
)";

/// '@' marks the expected place of the error.
struct MarkedScene {
  std::string text;
  FilePlace place;

  MarkedScene(std::string_view old_part, std::string_view new_part)
      : text(replaced(small_scene, old_part, new_part)) {
    const std::size_t mark = text.find('@');
    REQUIRE(mark != std::string::npos);
    place = {1, 1};
    for (std::size_t i = 0; i < mark; ++i) {
      ++place.column;
      if (text[i] == '\n') place = {place.line + 1, 1};
    }
    text.erase(mark, 1);
  }
};

/// Replaces `old_part` of `small_scene`. Checks that reading fails at the '@' with a message that contains all `parts`.
inline void check_error(std::string_view old_part, std::string_view new_part,
                        std::initializer_list<const char*> parts) {
  const MarkedScene scene(old_part, new_part);
  INFO("instead of: ", std::string(old_part), "\n      now: ", std::string(new_part));
  try {
    read_text(scene.text);
    FAIL_CHECK("no error");
  } catch (const SceneError& error) {
    INFO("message: ", std::string(error.what()), " key: ", error.key);
    CHECK(error.file == (scratch_folder() / "scene.toml").string());
    CHECK(error.line == scene.place.line);
    CHECK(error.column == scene.place.column);
    for (const char* part : parts) {
      INFO("expected: ", part);
      CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
  }
}

}  // namespace taut::test
