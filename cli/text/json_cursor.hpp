#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Typed access to JSON. Throws UsageError with the path ("measures.period.value"), the actual and the allowed value.
class JsonCursor {
 public:
  /// The arguments must outlive the cursor.
  JsonCursor(const Json& value, const std::string& file, std::string path = "");

  const std::string& path() const { return path_; }
  bool is_null() const;
  /// A missing key is null.
  JsonCursor at(const std::string& key) const;
  /// Empty for null.
  std::vector<std::pair<std::string, JsonCursor>> members() const;
  std::vector<JsonCursor> items() const;
  /// "" for null.
  std::string text() const;
  /// Returns a number as text.
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

/// Checks the keys that taut writes; all values can be null. Throws UsageError.
Json parse_run_json(const std::string& text, const std::string& file,
                    const std::vector<std::string>& verdicts);

}  // namespace taut::cli
