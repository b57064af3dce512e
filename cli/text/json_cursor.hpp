#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Typed access to a value of a JSON file. Every error is a UsageError with the file, the path of the key
/// ("measures.period.value"), the actual value and the allowed values.
class JsonCursor {
 public:
  /// The arguments must outlive the cursor.
  JsonCursor(const Json& value, const std::string& file, std::string path = "");

  const std::string& path() const { return path_; }
  bool is_null() const;
  /// Member of an object; a missing key gives null.
  JsonCursor at(const std::string& key) const;
  /// Members of an object, items of an array; none for null.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  std::vector<JsonCursor> items() const;
  /// "" for null.
  std::string text() const;
  /// A number as written in the file, or a text.
  std::string number_or_text() const;

  void check_object() const;
  void check_number_or_null() const;
  /// "" for null.
  std::string choice(const std::vector<std::string>& allowed) const;
  [[noreturn]] void fail(const std::string& allowed) const;

 private:
  const Json* value_;
  const std::string* file_;
  std::string path_;
};

/// Parses a run.json and checks the type of every key that taut writes; each may be null, and other keys are ignored.
/// `verdicts` lists the allowed verdicts. Throws UsageError.
Json parse_run_json(const std::string& text, const std::string& file,
                    const std::vector<std::string>& verdicts);

}  // namespace taut::cli
