#include <array>
#include <cmath>

#include <fmt/format.h>

#include "cli/formats/mask.hpp"
#include "cli/run/run.hpp"
#include "cli/scene/expression.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/toml_tree.hpp"
#include "cli/sweep/options.hpp"
#include "cli/sweep/sweep_file.hpp"
#include "engine/simulation.hpp"
#include "render/image/png.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/fuzz/small_scenes.hpp"

namespace taut::fuzz {

using namespace cli;

namespace {

void write_referenced_files() {
  write("table.csv", "t,tip,x\n0,0,0\n0.5,0.1,0.5\n1,0,1\n");
  write("particles.csv", "x,y,z,volume\n0,0,0,0.01\n0.1,0,0,0.01\n0.2,0,0.1,0.01\n");
  render::Image picture(8, 8);
  for (int k = 2; k < 6; ++k)
    for (int l = 2; l < 6; ++l) picture.set(k, l, {0, 0, 0});
  render::write_png(picture, folder() / "mask.png");
}

void make_particles(SceneFile& file) {
  file.settings.threads = 1;
  if (is_small(file.scene)) start(file);
}

/// The resolved scene must be readable and resolve to the same text.
void check_resolved(const SceneFile& file) {
  const std::string once = resolved_text(file, folder());
  SceneFile again;
  try {
    again = read_scene(write("resolved.toml", once));
  } catch (const std::runtime_error& error) {
    throw Finding(std::string("resolved.toml cannot be read: ") + error.what() + "\n" + once);
  }
  expect(resolved_text(again, folder()) == once,
         "resolved.toml changes when read and written again:\n" + once);
}

}  // namespace

bool is_small(const Scene& scene) {
  constexpr double most_places = 2000;
  double places = 0;
  for (const Body& body : scene.bodies)
    for (const Shape& shape : body.shapes) {
      const Bounds all = shape->lattice_bounds();
      double of_shape = 1;
      for (std::size_t k = 0; k < static_cast<std::size_t>(scene.dim); ++k)
        of_shape *= (all.high[k] - all.low[k]) / scene.spacing + 3;
      places += of_shape;
    }
  return places < most_places;
}

void read_toml(std::string_view bytes) {
  const std::string once = print_toml(parse_toml(bytes, "fuzz.toml"));
  std::string again;
  attempt([&] { again = print_toml(parse_toml(once, "printed.toml")); });
  expect(again == once, "TOML changes when printed and read again:\n" + once);
}

void read_scene_file(std::string_view bytes) {
  write_referenced_files();
  SceneFile file = read_scene(write("scene.toml", bytes));
  check_resolved(file);
  make_particles(file);
}

void read_sweep_file(std::string_view bytes) {
  const std::vector<std::string> parts = parts_of(bytes, 2);
  write("small.toml", parts[1]);
  const std::filesystem::path path = write("sweep.toml", parts[0]);
  if (!is_sweep_file(path)) return;
  constexpr std::size_t most_rows = 4;
  if (read_sweep(path).rows.size() > most_rows) return;
  SceneFile scene = read_scene(folder() / "small.toml");
  if (!is_small(scene.scene)) return;
  SweepOptions options;
  options.what = path.string();
  options.run.out = (folder() / "out").string();
  plan_sweep(make_request(options));
}

void read_expression(std::string_view bytes) {
  const std::string text(bytes);
  const Names names{{"a", 2}, {"speed", 0.5}, {"c0", 10}};
  const auto each = [](const auto& reading) {
    attempt([&] {
      try {
        reading();
      } catch (const ExpressionError&) {
      }
    });
  };
  each([&] { evaluate(text, names); });
  each([&] { compile(text, names)({0.1, 0.2, 0.3}); });
  each([&] { compile_of_time(text, names)(0.5); });
  each([&] { compile_in_time(text, names)({0.1, 0.2, 0.3}, 0.5); });
  each([&] { compile_of_values(text, names, {"tip", "gap"})({1, 2}, 0.5); });
  each([&] { names_in(text); });
  each([&] { evaluate("1", {{text, 1}}); });  // TOML allows any name
}

void read_outline(std::string_view bytes) {
  if (bytes.size() < 4) return;
  const int kind = bytes[0] & 7, columns = 1 + (bytes[1] & 31);
  const std::string_view rest = bytes.substr(2);
  const auto byte = [&](std::size_t k) { return static_cast<signed char>(rest[k]); };
  std::string shape;
  if (kind < 4) {
    std::string points;
    for (std::size_t k = 0; k + 1 < rest.size(); k += 2)
      points += fmt::format("[{}, {}],", byte(k) / 16., byte(k + 1) / 16.);
    shape = fmt::format("{{ type = 'polygon', points = [{}] }}", points);
  } else {
    const int rows = std::min(64, static_cast<int>(rest.size()) / columns);
    if (rows == 0) return;
    render::Image picture(columns, rows);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const auto gray = static_cast<std::uint8_t>(rest[static_cast<std::size_t>(row * columns + column)]);
        picture.set(column, row, {gray, gray, gray});
      }
    render::write_png(picture, folder() / "mask.png");
    shape = "{ type = 'mask', file = 'mask.png', height = 4, centre = [0, 0] }";
  }
  constexpr std::array more = {"", "", ", { type = 'disc', centre = [1, 0], radius = 2 }",
                               ", { type = 'rectangle', low = [0, 0], high = [3, 3] }"};
  SceneFile file = read_scene(
      write("scene.toml",
            fmt::format("spacing = 0.25\nuntil = 1\nmethod = '{}'\n[material.m]\ndensity = 1\n"
                        "youngs_modulus = 1\npoisson_ratio = 0.3\n[[body]]\nname = 'b'\nmaterial = 'm'\n"
                        "shape = [{}{}]\n",
                        kind & 1 ? "tl" : "enog", shape, more[static_cast<std::size_t>(kind & 3)])));
  make_particles(file);
}

void read_svg_file(std::string_view bytes) {
  constexpr int rows = 64;
  for (const Chain& chain : faces_of(paint_svg(write("shape.svg", bytes), rows), 0.5))
    expect(chain.size() >= 3, "an outline has fewer than three points");
}

}  // namespace taut::fuzz
