#include "cli/formats/particle_columns.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/core.h>

#include "cli/formats/particle_arrays.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

using Type = ParticleArray::Type;

struct Column {
  std::string name;
  std::string_view unit;
  const ParticleArray* array;
  std::size_t component = 0;
  double scale = 1;

  double at(std::size_t i) const { return scale * array->values[array->width() * i + component]; }
};

template <class Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

void append_value(std::string& text, const Column& column, std::size_t i, bool single_precision) {
  if (column.array->type != Type::real)
    append_number(text, static_cast<int>(column.at(i)));
  else if (single_precision)
    append_number(text, static_cast<float>(column.at(i)));
  else
    append_number(text, column.at(i));
}

/// "displacement_x".
std::string column_name(const ParticleArray& array, std::size_t component) {
  std::string_view stem = array.name;
  if (array.components.empty()) return std::string(stem);
  if (stem.ends_with("_vector")) stem.remove_suffix(std::string_view("_vector").size());
  return std::string(stem).append("_").append(array.components[component]);
}

std::set<std::string> component_names(const std::vector<ParticleArray>& arrays) {
  std::set<std::string> names;
  for (const ParticleArray& array : arrays)
    for (std::size_t c = 0; c < array.components.size(); ++c) names.insert(column_name(array, c));
  return names;
}

bool is_zero_in_2d(const ParticleArray& array, std::size_t component) {
  if (array.components.empty()) return false;
  const std::string_view axes = array.components[component];
  return axes == "z" || axes == "xz" || axes == "yz";
}

struct Property {
  std::string_view array, name;  // `name`: in OVITO's manual
  double scale = 1;
};
constexpr std::array properties{Property{"velocity", "velo"}, Property{"displacement_vector", "disp"},
                                Property{"diameter", "radius", 0.5}};

/// Indices of xx, yy, zz, xy, xz, yz in VTK's order.
constexpr std::array<std::size_t, 6> ovito_order{0, 1, 2, 3, 5, 4};

void add_property(std::vector<Column>& columns, std::string& text, const ParticleArray& array) {
  const auto* known = std::ranges::find(properties, array.name, &Property::array);
  const bool renamed = known != properties.end();
  const std::size_t width = array.width();
  text += fmt::format(":{}:{}:{}", renamed ? known->name : array.name, array.type == Type::real ? 'R' : 'I',
                      width);
  for (std::size_t c = 0; c < width; ++c)
    columns.push_back(
        {"", "", &array, width == ovito_order.size() ? ovito_order[c] : c, renamed ? known->scale : 1});
}

std::string box_around(const ParticleArray& positions, const std::vector<double>& diameter) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < positions.values.size(); ++k) {
    const double radius = 0.5 * diameter[k / 3];
    low[k % 3] = std::fmin(low[k % 3], positions.values[k] - radius);
    high[k % 3] = std::fmax(high[k % 3], positions.values[k] + radius);
  }
  return fmt::format("Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\"", exact(high[0] - low[0]),
                     exact(high[1] - low[1]), exact(high[2] - low[2]), exact(low[0]), exact(low[1]),
                     exact(low[2]));
}

}  // namespace

std::string extended_xyz_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision) {
  const ParticleArray positions = position_array(snapshot);
  const std::vector<ParticleArray> arrays = particle_arrays(snapshot, fields);
  const std::set<std::string> components = component_names(arrays);
  std::vector<Column> columns;
  std::string list = "species:S:1:pos:R:3";
  for (std::size_t c = 0; c < positions.width(); ++c) columns.push_back({"", "", &positions, c});
  for (const ParticleArray& array : arrays)
    if (!components.contains(std::string(array.name))) add_property(columns, list, array);
  std::string text = fmt::format("{}\n{} pbc=\"F F F\" Properties={} Time={}\n", snapshot.size(),
                                 box_around(positions, snapshot.diameter), list, exact(snapshot.time));
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    text += 'X';
    for (const Column& column : columns) append_value(text += ' ', column, i, single_precision);
    text += '\n';
  }
  return text;
}

std::string particle_csv_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                              bool single_precision) {
  const ParticleArray positions = position_array(snapshot);
  const std::vector<ParticleArray> arrays = particle_arrays(snapshot, fields);
  std::vector<Column> columns;
  const auto add = [&](const ParticleArray& array, std::size_t component, std::string name) {
    const bool is_twin = std::ranges::find(columns, name, &Column::name) != columns.end();
    if (!is_twin && (snapshot.dim == 3 || !is_zero_in_2d(array, component)))
      columns.push_back({std::move(name), array.unit, &array, component});
  };
  add(*std::ranges::find(arrays, "id", &ParticleArray::name), 0, "id");
  for (std::size_t c = 0; c < positions.width(); ++c) add(positions, c, std::string(positions.components[c]));
  for (const ParticleArray& array : arrays)
    for (std::size_t c = 0; c < array.width(); ++c) add(array, c, column_name(array, c));

  std::string text = "time [s]";
  for (const Column& column : columns)
    text += "," + column.name + (column.unit.empty() ? "" : fmt::format(" [{}]", column.unit));
  text += '\n';
  const std::string time = exact(snapshot.time);
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    text += time;
    for (const Column& column : columns) append_value(text += ',', column, i, single_precision);
    text += '\n';
  }
  return text;
}

}  // namespace taut::cli
