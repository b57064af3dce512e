#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

struct NumberRange {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;  // excludes the bound
};
constexpr NumberRange above(double low) { return {.low = low, .open_low = true}; }
constexpr NumberRange at_least(double low) { return {.low = low}; }

struct KeyType {
  enum class Kind : std::uint8_t {
    number,  // or expression
    whole,   // or expression
    flag,
    text,
    word,
    vector,
    table,
  };
  enum class Form : std::uint8_t { one, list, one_or_list };
  static constexpr std::size_t any_size = static_cast<std::size_t>(-1);

  Kind kind = Kind::text;
  std::string_view shown = {};  // in documentation
  std::string_view unit = {};
  NumberRange bounds = {};
  std::array<std::string_view, 8> words = {};
  std::vector<std::string> (*names)() = nullptr;
  std::string_view section = {};  // keys of a table
  std::string_view pattern = {};
  std::size_t longest = any_size;
  std::size_t size = 0;         // components; 0: one per axis
  std::string_view other = {};  // further value, such as "auto" or "=EXPRESSION"
  Form form = Form::one;
  std::size_t depth = 1;                   // of nested arrays
  std::size_t least = 0, most = any_size;  // items of the innermost array
  std::string_view by = {};                // "MEASURE": one value per measure
  std::string_view name_pattern = {};

  constexpr KeyType or_other(std::string_view word) const {
    KeyType type = *this;
    type.other = word;
    return type;
  }
  constexpr KeyType list(std::size_t least_items = 0, std::size_t most_items = any_size) const {
    KeyType type = *this;
    type.form = Form::list, type.least = least_items, type.most = most_items;
    return type;
  }
  constexpr KeyType or_list(std::size_t least_items = 0, std::size_t most_items = any_size) const {
    KeyType type = list(least_items, most_items);
    type.form = Form::one_or_list;
    return type;
  }
  constexpr KeyType nested() const {
    KeyType type = *this;
    ++type.depth;
    return type;
  }
  constexpr KeyType by_name(std::string_view kind_of_name, std::string_view pattern_of_name = {}) const {
    KeyType type = *this;
    type.by = kind_of_name, type.name_pattern = pattern_of_name;
    return type;
  }
};

std::string type_text(const KeyType& type);
std::vector<std::string> words_of(const KeyType& type);
/// "must be greater than 0", or "" if allowed.
std::string against_bounds(const KeyType& type, double value);

namespace types {

constexpr KeyType number(std::string_view unit = {}, NumberRange bounds = {}) {
  return {.kind = KeyType::Kind::number, .unit = unit, .bounds = bounds};
}
/// `shown`: "expression of t".
constexpr KeyType expression(std::string_view shown) {
  return {.kind = KeyType::Kind::number, .shown = shown};
}
constexpr KeyType whole(double low, double high) {
  return {.kind = KeyType::Kind::whole, .bounds = {.low = low, .high = high}};
}
constexpr KeyType flag() { return {.kind = KeyType::Kind::flag}; }
constexpr KeyType text(std::string_view shown = "text") { return {.shown = shown}; }
/// See TomlCursor::line.
constexpr KeyType line(std::string_view pattern = "^[^\\u0000-\\u001f\\u007f]*$") {
  return {.shown = "text", .pattern = pattern, .longest = 200};
}
constexpr KeyType label() {
  return {.shown = "letters, digits, _ and -", .pattern = "^[A-Za-z0-9_-]+$", .longest = 100};
}
template <class... Words>
constexpr KeyType word(Words... words) {
  return {.kind = KeyType::Kind::word, .words = {words...}};
}
constexpr KeyType one_of(std::string_view shown, std::vector<std::string> (*names)()) {
  return {.kind = KeyType::Kind::word, .shown = shown, .names = names};
}
constexpr KeyType vector(std::string_view shown = "[x, y]", std::string_view unit = {},
                         NumberRange bounds = {}) {
  return {.kind = KeyType::Kind::vector, .shown = shown, .unit = unit, .bounds = bounds};
}
constexpr KeyType vector_of(std::size_t size, std::string_view shown, std::string_view unit = {},
                            NumberRange bounds = {}) {
  return {.kind = KeyType::Kind::vector, .shown = shown, .unit = unit, .bounds = bounds, .size = size};
}
constexpr KeyType number_or_table(std::string_view shown, std::string_view section) {
  return {.kind = KeyType::Kind::number, .shown = shown, .section = section};
}
/// `shown`: "[[body]]", "{ file, column }".
constexpr KeyType table(std::string_view section, std::string_view shown) {
  return {.kind = KeyType::Kind::table, .shown = shown, .section = section};
}

}  // namespace types

struct KeyInfo {
  std::string_view name;  // or `any_name`
  KeyType type;
  std::string_view by_default;  // empty: required; "or X": required without X
  std::string_view help;
};

/// nullopt for words such as "the method's".
std::optional<double> default_number(const KeyInfo& key);

inline constexpr std::string_view any_name = "NAME";
inline constexpr KeyInfo named_by_user[] = {{any_name, {}, "", ""}};

struct Section {
  std::string_view name;
  std::string_view header;  // "[[body]]"
  std::string_view help;
  std::span<const KeyInfo> keys;
};

/// The file itself comes first.
std::span<const Section> scene_sections();
std::span<const Section> sweep_sections();
std::span<const Section> claim_sections();
std::span<const Section> suite_sections();
const Section& find_section(std::string_view name);
std::span<const KeyInfo> keys_of(std::string_view section);
const KeyInfo& key_of_scene(std::string_view name);

}  // namespace taut::cli
