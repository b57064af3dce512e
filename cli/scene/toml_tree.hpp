#pragma once

#include <list>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Place in a file, 1-based; 0: unknown.
struct FilePlace {
  int line = 0, column = 0;
};

struct TomlEntry;

/// Tables keep the order of their keys.
struct TomlValue {
  enum class Kind { table, array, text, number, boolean, date };
  Kind kind = Kind::table;
  FilePlace place;
  std::string text;
  bool verbatim = false;  // text without escapes: its offsets are columns of the file
  double number = 0;
  bool whole = false;  // without point and exponent
  bool flag = false;
  bool section = false;          // under its own [header]
  std::list<TomlEntry> entries;  // a list keeps pointers to entries valid
  std::vector<TomlValue> items;

  TomlValue() = default;
  explicit TomlValue(double of_number);
  explicit TomlValue(std::string of_text);

  TomlEntry* find(std::string_view key);
  const TomlEntry* find(std::string_view key) const;
  /// Replaces or appends. The new value gets the place of the old value, or of the table.
  void set(std::string_view key, TomlValue value);
  /// "a number", "a table", ...
  std::string_view kind_name() const;
};

struct TomlEntry {
  std::string key;
  FilePlace place;
  TomlValue value;
  bool known = false;  // was read
};

/// Throws SceneError with the place of a syntax error.
TomlValue parse_toml(std::string_view text, const std::string& file);

/// Numbers read back exactly.
std::string print_toml(const TomlValue& root);

}  // namespace taut::cli
