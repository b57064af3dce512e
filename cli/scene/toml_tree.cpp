#include "cli/scene/toml_tree.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/error.hpp"

#ifndef TOML_HEADER_ONLY  // pkg-config may define it as 0
#define TOML_HEADER_ONLY 1
#endif
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace taut::cli {
namespace {

FilePlace place_of(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

/// toml++ limits nested brackets, but not dotted keys.
constexpr int most_parts = 16, most_levels = 300;

std::size_t end_of_quoted(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool long_one = text.substr(at, 3) == std::string(3, quote);
  for (std::size_t i = at + (long_one ? 3 : 1); i < text.size(); ++i) {
    if (!long_one && (text[i] == quote || text[i] == '\n')) return i + 1;
    if (long_one && text.substr(i, 3) == std::string(3, quote)) {
      std::size_t end = i + 3;  // two more quotes may belong to the text [TOML 1.0, String]
      while (end < std::min(i + 5, text.size()) && text[end] == quote) ++end;
      return end;
    }
    const bool escapes = text[i] == '\\' && quote == '"';
    if (escapes && (long_one || text.substr(i + 1, 1) != "\n")) ++i;
  }
  return text.size();
}

FilePlace place_in(std::string_view text, std::size_t at) {
  FilePlace place{1, 1};
  for (const char c : text.substr(0, at)) c == '\n' ? (++place.line, place.column = 1) : ++place.column;
  return place;
}

void refuse_long_keys(std::string_view text, const std::string& file) {
  constexpr std::string_view between = "=,[]{}\n";
  std::size_t begin = 0;
  for (std::size_t i = 0, dots = 0; i < text.size();) {
    if (text[i] == '"' || text[i] == '\'') {
      i = end_of_quoted(text, i);
      continue;
    }
    if (text[i] == '#') i = std::min(text.find('\n', i), text.size() - 1);
    if (between.find(text[i]) != std::string_view::npos) dots = 0, begin = i + 1;
    dots += text[i++] == '.' ? 1 : 0;
    if (dots < most_parts) continue;
    begin = text.find_first_not_of(' ', begin);
    const FilePlace place = place_in(text, begin);
    throw SceneError(file, place.line, place.column, "",
                     fmt::format("not valid TOML for taut: a key has more than {} parts between dots; "
                                 "use a shorter key",
                                 most_parts));
  }
}

TomlValue converted(const toml::node& node, const std::string& file, int level = 0);

/// Restores the file's order of keys, which toml++ sorts.
void add_entries(TomlValue& value, const toml::table& table, const std::string& file, int level) {
  for (const auto& [key, node] : table)
    value.entries.push_back({.key = std::string(key.str()),
                             .place = place_of(key.source().begin),
                             .value = converted(node, file, level)});
  value.entries.sort([](const TomlEntry& a, const TomlEntry& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

TomlValue converted(const toml::node& node, const std::string& file, int level) {
  using Kind = TomlValue::Kind;
  TomlValue value;
  value.place = place_of(node.source().begin);
  if (level > most_levels)
    throw SceneError(
        file, value.place.line, value.place.column, "",
        fmt::format("tables and arrays are nested more than {} levels deep; use fewer levels", most_levels));
  if (const toml::table* table = node.as_table()) {
    value.section = !table->is_inline();
    add_entries(value, *table, file, level + 1);
  } else if (const toml::array* array = node.as_array()) {
    value.kind = Kind::array;
    for (const toml::node& item : *array) value.items.push_back(converted(item, file, level + 1));
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

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(c));
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string key_text(const std::string& key) {
  constexpr std::string_view bare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !key.empty() && key.find_first_not_of(bare) == std::string::npos ? key : toml_string(key);
}

std::string number_text(const TomlValue& value) {
  std::string text = exact(value.number);
  // a large number without point would overflow a TOML integer
  if (!value.whole && text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string value_text(const TomlValue& value) {
  using Kind = TomlValue::Kind;
  switch (value.kind) {
    case Kind::text:
      return toml_string(value.text);
    case Kind::number:
      return number_text(value);
    case Kind::boolean:
      return value.flag ? "true" : "false";
    case Kind::array: {
      std::vector<std::string> items;
      for (const TomlValue& item : value.items) items.push_back(value_text(item));
      return fmt::format("[{}]", join(items));
    }
    case Kind::table: {
      std::vector<std::string> entries;
      for (const TomlEntry& entry : value.entries)
        entries.push_back(fmt::format("{} = {}", key_text(entry.key), value_text(entry.value)));
      return entries.empty() ? "{}" : fmt::format("{{ {} }}", join(entries));
    }
    case Kind::date:
      break;
  }
  return "";
}

bool is_section(const TomlValue& value) { return value.kind == TomlValue::Kind::table && value.section; }

bool is_section_list(const TomlValue& value) {
  return value.kind == TomlValue::Kind::array && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(), is_section);
}

/// Plain values come first: after a [header] they would belong to it.
void print_section(std::string& text, const TomlValue& table, const std::string& path) {
  for (const TomlEntry& entry : table.entries)
    if (!is_section(entry.value) && !is_section_list(entry.value))
      text += fmt::format("{} = {}\n", key_text(entry.key), value_text(entry.value));
  for (const TomlEntry& entry : table.entries) {
    const std::string inner = fmt::format("{}{}{}", path, path.empty() ? "" : ".", key_text(entry.key));
    if (is_section_list(entry.value)) {
      for (const TomlValue& item : entry.value.items) {
        text += fmt::format("\n[[{}]]\n", inner);
        print_section(text, item, inner);
      }
    } else if (is_section(entry.value)) {
      const auto& entries = entry.value.entries;
      const bool only_sections =
          !entries.empty() && std::all_of(entries.begin(), entries.end(), [](const TomlEntry& e) {
            return is_section(e.value) || is_section_list(e.value);
          });
      if (!only_sections) text += fmt::format("\n[{}]\n", inner);
      print_section(text, entry.value, inner);
    }
  }
}

}  // namespace

TomlValue::TomlValue(double of_number) : kind(Kind::number), number(of_number) {}

TomlValue::TomlValue(std::string of_text) : kind(Kind::text), text(std::move(of_text)) {}

TomlEntry* TomlValue::find(std::string_view key) {
  return const_cast<TomlEntry*>(std::as_const(*this).find(key));
}

const TomlEntry* TomlValue::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

void TomlValue::set(std::string_view key, TomlValue value) {
  if (TomlEntry* entry = find(key)) {
    value.place = entry->value.place;
    entry->value = std::move(value);
  } else {
    if (value.place.line == 0) value.place = place;
    entries.push_back({.key = std::string(key), .place = place, .value = std::move(value), .known = true});
  }
}

std::string_view TomlValue::kind_name() const {
  switch (kind) {
    case Kind::table:
      return "a table";
    case Kind::array:
      return "an array";
    case Kind::text:
      return "a text";
    case Kind::number:
      return "a number";
    case Kind::boolean:
      return "a boolean";
    case Kind::date:
      return "a date or time";
  }
  return "";
}

namespace {

std::string_view line_of(std::string_view text, int number) {
  for (; number > 1; --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

std::string mistake_hint(std::string_view line, std::string_view message) {
  if (std::ranges::count(line, '"') % 2 == 1) return ". Is a quote missing in this line?";
  if (message.find("redefine existing") != std::string_view::npos)
    return ". Sections that occur several times need two brackets: [[body]]";
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos || line.find('"') != std::string_view::npos) return "";
  const std::size_t value = line.find_first_not_of(" \t", equals + 1);
  const bool bare = value != std::string_view::npos && std::isalpha(static_cast<unsigned char>(line[value]));
  const bool computed = line.find_first_of("*/(<>", equals + 1) != std::string_view::npos;
  return bare || computed ? ". Texts and expressions need quotes: KEY = \"...\"" : "";
}

}  // namespace

TomlValue parse_toml(std::string_view text, const std::string& file) {
  try {
    refuse_long_keys(text, file);
    return converted(toml::parse(text, std::string_view(file)), file);
  } catch (const toml::parse_error& error) {
    const FilePlace place = place_of(error.source().begin);
    throw SceneError(file, place.line, place.column, "",
                     fmt::format("not valid TOML: {}{}", error.description(),
                                 mistake_hint(line_of(text, place.line), error.description())));
  }
}

std::string print_toml(const TomlValue& root) {
  std::string text;
  print_section(text, root, "");
  return text;
}

}  // namespace taut::cli
