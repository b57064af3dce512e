#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Typed access to a value of a JSON file. Every error is a UsageError with the file, the path of the key
/// ("measures.period.value"), what is there and what may be.
class JsonCursor {
 public:
  /// Both live longer than the cursor.
  JsonCursor(const Json& value, const std::string& file, std::string path = "");

  const std::string& path() const { return path_; }
  bool is_null() const;
  /// Of an object. A key that is not there is null.
  JsonCursor at(const std::string& key) const;
  /// Of an object or an array; of null none.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  std::vector<JsonCursor> items() const;
  /// "" of null.
  std::string text() const;
  /// A number as it stands in the file, or a text.
  std::string number_or_text() const;

  void check_object() const;
  void check_number_or_null() const;
  /// "" of null.
  std::string choice(const std::vector<std::string>& allowed) const;
  [[noreturn]] void fail(const std::string& allowed) const;

 private:
  const Json* value_;
  const std::string* file_;
  std::string path_;
};

/// The run.json of a run of taut: every key that taut writes holds what taut writes there, or null; other keys
/// hold what they like. `verdicts` are the names of verdicts. Throws as JsonCursor does.
Json parse_run_json(const std::string& text, const std::string& file,
                    const std::vector<std::string>& verdicts);

}  // namespace taut::cli
