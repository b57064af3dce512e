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

struct TomlValue {
  enum class Kind { table, array, text, number, boolean, date };
  Kind kind = Kind::table;
  FilePlace place;
  std::string text;
  bool verbatim = false;  // text as in the file; its offsets give columns
  double number = 0;
  bool whole = false;  // without point and exponent
  bool flag = false;
  bool section = false;          // table that is not inline
  std::list<TomlEntry> entries;  // a list keeps pointers to entries valid
  std::vector<TomlValue> items;

  TomlValue() = default;
  explicit TomlValue(double of_number);
  explicit TomlValue(std::string of_text);

  TomlEntry* find(std::string_view key);
  const TomlEntry* find(std::string_view key) const;
  /// Replaces a value in place, or appends an entry.
  void set(std::string_view key, TomlValue value);
  /// "a number"
  std::string_view kind_name() const;
};

struct TomlEntry {
  std::string key;
  FilePlace place;
  TomlValue value;
  bool known = false;  // read or added
};

/// Throws SceneError.
TomlValue parse_toml(std::string_view text, const std::string& file);

/// Numbers read back exactly.
std::string print_toml(const TomlValue& root);

}  // namespace taut::cli
