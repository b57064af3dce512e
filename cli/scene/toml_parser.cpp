#include <algorithm>

#include "cli/scene/toml_tree.hpp"
#include "engine/error.hpp"

#ifndef TOML_HEADER_ONLY  // pkg-config may say that it is a library
#define TOML_HEADER_ONLY 1
#endif
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace taut::cli {
namespace {

FilePlace place_of(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

TomlValue converted(const toml::node& node);

/// toml++ sorts the keys of a table; the file's order is that of their places.
void add_entries(TomlValue& value, const toml::table& table) {
  for (const auto& [key, node] : table)
    value.entries.push_back(
        {.key = std::string(key.str()), .place = place_of(key.source().begin), .value = converted(node)});
  value.entries.sort([](const TomlEntry& a, const TomlEntry& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

TomlValue converted(const toml::node& node) {
  using Kind = TomlValue::Kind;
  TomlValue value;
  if (const toml::table* table = node.as_table()) {
    value.section = !table->is_inline();
    add_entries(value, *table);
  } else if (const toml::array* array = node.as_array()) {
    value.kind = Kind::array;
    for (const toml::node& item : *array) value.items.push_back(converted(item));
  } else if (const auto* text = node.as_string()) {
    value = TomlValue(text->get());
    const toml::source_region& region = node.source();
    value.verbatim = region.begin.line == region.end.line &&
                     region.end.column - region.begin.column == value.text.size() + 2;
  } else if (const auto* real = node.as_floating_point()) {
    value = TomlValue(real->get());
  } else if (const auto* whole = node.as_integer()) {
    value = TomlValue(static_cast<double>(whole->get()));
    value.whole = true;
  } else if (const auto* flag = node.as_boolean()) {
    value.kind = Kind::boolean;
    value.flag = flag->get();
  } else {
    value.kind = Kind::date;
  }
  value.place = place_of(node.source().begin);
  return value;
}

}  // namespace

TomlValue parse_toml(std::string_view text, const std::string& file) {
  try {
    return converted(toml::parse(text, std::string_view(file)));
  } catch (const toml::parse_error& error) {
    const FilePlace place = place_of(error.source().begin);
    throw SceneError(file, place.line, place.column, "",
                     "not valid TOML: " + std::string(error.description()));
  }
}

}  // namespace taut::cli
