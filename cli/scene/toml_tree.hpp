#pragma once

#include <list>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Place in a file, 1-based; 0 = unknown.
struct FilePlace {
  int line = 0, column = 0;
};

struct TomlEntry;

/// A value of a TOML file with its place. Tables keep the order of the file.
struct TomlValue {
  enum class Kind { table, array, text, number, boolean, date };
  Kind kind = Kind::table;
  FilePlace place;
  std::string text;
  bool verbatim = false;  // text without escapes on one line, so that columns match
  double number = 0;
  bool whole = false;  // number without point and exponent
  bool flag = false;
  bool section = false;          // table under its own [header], not { key = value }
  std::list<TomlEntry> entries;  // of a table; a list, so that pointers to entries stay valid
  std::vector<TomlValue> items;

  TomlValue() = default;
  explicit TomlValue(double of_number);
  explicit TomlValue(std::string of_text);

  /// Returns nullptr if missing.
  TomlEntry* find(std::string_view key);
  const TomlEntry* find(std::string_view key) const;
  /// Replaces or appends the value of `key`. A replaced value keeps its place; a new one gets the table's.
  void set(std::string_view key, TomlValue value);
  /// "a number", "a table", ...
  std::string_view kind_name() const;
};

struct TomlEntry {
  std::string key;
  FilePlace place;
  TomlValue value;
  bool known = false;  // has been read
};

/// Parses TOML. Throws SceneError with the place of a syntax error.
TomlValue parse_toml(std::string_view text, const std::string& file);

/// Formats TOML. Numbers read back exactly; reading and printing the text again gives the same text.
std::string print_toml(const TomlValue& root);

}  // namespace taut::cli
