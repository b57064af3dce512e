#pragma once

#include <list>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Where something stands in a file, 1-based; 0 = unknown.
struct FilePlace {
  int line = 0, column = 0;
};

struct TomlEntry;

/// A value of a TOML file that knows its place. Tables keep the order of the file.
struct TomlValue {
  enum class Kind { table, array, text, number, boolean, date };
  Kind kind = Kind::table;
  FilePlace place;
  std::string text;              // of a text
  bool verbatim = false;         // text: stands in the file letter by letter, between two quotes
  double number = 0;             // of a number
  bool whole = false;            // number: without point and exponent
  bool flag = false;             // of a boolean
  bool section = false;          // table: written under a [header] of its own, not as { key = value }
  std::list<TomlEntry> entries;  // of a table; a list, since whoever reads it appends what is missing
  std::vector<TomlValue> items;  // of an array

  TomlValue() = default;
  explicit TomlValue(double of_number);
  explicit TomlValue(std::string of_text);

  /// nullptr if the table has no such key.
  TomlEntry* find(std::string_view key);
  const TomlEntry* find(std::string_view key) const;
  /// Replaces the value of `key`, which keeps its place, or appends it; the table's place is good enough
  /// then.
  void set(std::string_view key, TomlValue value);
  /// "a number", "a table", ...
  std::string_view kind_name() const;
};

struct TomlEntry {
  std::string key;
  FilePlace place;  // of the key
  TomlValue value;
  bool known = false;  // somebody has asked for it
};

/// Throws SceneError with the place of a syntax error.
TomlValue parse_toml(std::string_view text, const std::string& file);

/// TOML with numbers that read back bit by bit; reading and printing it again gives the same text.
std::string print_toml(const TomlValue& root);

}  // namespace taut::cli
