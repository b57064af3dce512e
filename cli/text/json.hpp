#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace taut::cli {

class Json {
 public:
  using Member = std::pair<std::string, Json>;

  Json(std::nullptr_t = nullptr) {}
  Json(bool value) : value_(value) {}
  template <std::integral Integer>
  Json(Integer value)
      : value_(
            static_cast<std::conditional_t<std::is_signed_v<Integer>, std::int64_t, std::uint64_t>>(value)) {}
  /// Non-finite numbers are written as null.
  Json(double value) : value_(value) {}
  Json(std::optional<double> value);
  Json(const char* text) : Json(std::string_view(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  Json(const std::vector<std::string>& texts);
  Json(std::initializer_list<Member> members);
  Json(const Json&);
  Json(Json&&) noexcept;
  ~Json();
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;

  static Json array();
  static Json object() { return std::initializer_list<Member>(); }

  bool operator==(const Json& other) const;

  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  bool is_object() const { return std::holds_alternative<std::vector<Member>>(value_); }
  bool is_array() const { return std::holds_alternative<std::vector<Json>>(value_); }
  bool is_text() const { return std::holds_alternative<std::string>(value_); }
  bool is_number() const;
  bool is_float() const { return std::holds_alternative<double>(value_); }

  double number() const;
  const std::string& text() const { return std::get<std::string>(value_); }
  const std::vector<Json>& items() const { return std::get<std::vector<Json>>(value_); }
  const std::vector<Member>& members() const { return std::get<std::vector<Member>>(value_); }
  const Json* find(std::string_view key) const;

  /// Adds a missing member as null. A null value becomes an object.
  Json& operator[](std::string_view key);
  /// Requires that the key is new.
  void append(std::string key, Json value);
  /// A null value becomes an array.
  void add(Json item);
  /// Copy with the missing members from `other`.
  Json with(const Json& other) const;

  /// One line, or with `indent` a line per value. Replaces invalid UTF-8.
  std::string dump(int indent = -1) const;
  /// Innermost values by JSON pointer: "/measures/period/value".
  std::vector<Member> leaves() const;

  const auto& value() const { return value_; }

 private:
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, std::vector<Json>,
               std::vector<Member>>
      value_;
};

/// Throws UsageError for invalid JSON, repeated keys and more than 64 levels.
Json parse_json(const std::string& text, const std::string& file);

Json number_or_text(const std::string& text);

}  // namespace taut::cli
