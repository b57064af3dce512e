#include "cli/scene/key_info.hpp"

#include <cmath>

#include <fmt/core.h>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

/// "0 ≤ number < 0.5".
std::string bounded(std::string_view name, const NumberRange& bounds) {
  std::string text(name);
  const bool low = std::isfinite(bounds.low), high = std::isfinite(bounds.high);
  if (low && high) text = fmt::format("{} {} {}", exact(bounds.low), bounds.open_low ? "<" : "≤", text);
  if (low && !high) text += fmt::format(" {} {}", bounds.open_low ? ">" : "≥", exact(bounds.low));
  if (high) text += fmt::format(" {} {}", bounds.open_high ? "<" : "≤", exact(bounds.high));
  return text;
}

std::string one_text(const KeyType& type) {
  using Kind = KeyType::Kind;
  if (!type.shown.empty()) return std::string(type.shown);
  if (type.kind == Kind::flag) return "true or false";
  if (type.kind == Kind::word) {
    std::vector<std::string> words = words_of(type);
    if (!type.other.empty()) words.emplace_back(type.other);
    return join_with_or(std::move(words));
  }
  if (type.kind == Kind::number) return bounded("number", type.bounds);
  if (type.bounds.high == type.bounds.low + 1)
    return fmt::format("{} or {}", exact(type.bounds.low), exact(type.bounds.high));
  return bounded("whole number", type.bounds);
}

std::string list_text(const KeyType& type, std::string text) {
  constexpr std::size_t most_repeated = 3;
  if (type.form == KeyType::Form::one_or_list)
    return fmt::format("{}{} or an array of them", text,
                       type.kind == KeyType::Kind::word && type.shown.empty() ? "," : "");
  if (type.least > 1 && type.most <= most_repeated)
    return fmt::format("[{}]", join(std::vector<std::string>(type.least, text)));
  for (std::size_t k = 0; k < type.depth; ++k) text = fmt::format("[{}, ...]", text);
  return text;
}

std::string bounds_sentence(const NumberRange& bounds) {
  const bool low = std::isfinite(bounds.low), high = std::isfinite(bounds.high);
  std::string text;
  if (low) text = fmt::format("{} {}", bounds.open_low ? "greater than" : "at least", exact(bounds.low));
  if (high)
    text += fmt::format("{}{} {}", low ? " and " : "", bounds.open_high ? "below" : "at most",
                        exact(bounds.high));
  return text;
}

}  // namespace

std::string against_bounds(const KeyType& type, double value) {
  const NumberRange& bounds = type.bounds;
  const bool whole = type.kind == KeyType::Kind::whole;
  const bool above = bounds.open_low ? value > bounds.low : value >= bounds.low;
  const bool below = bounds.open_high ? value < bounds.high : value <= bounds.high;
  if (above && below && (!whole || value == std::floor(value))) return "";
  if (whole)
    return fmt::format("must be a whole number from {} to {}", exact(bounds.low), exact(bounds.high));
  return "must be " + bounds_sentence(bounds);
}

std::optional<double> default_number(const KeyInfo& key) {
  return parsed<double>(std::string(key.by_default));
}

std::vector<std::string> words_of(const KeyType& type) {
  if (type.names) return type.names();
  std::vector<std::string> words;
  for (const std::string_view word : type.words)
    if (!word.empty()) words.emplace_back(word);
  return words;
}

std::string type_text(const KeyType& type) {
  std::string text = one_text(type);
  const bool has_header = type.kind == KeyType::Kind::table && text.front() == '[';
  if (has_header) return text;
  if (type.form != KeyType::Form::one) text = list_text(type, std::move(text));
  const bool names_other = type.kind == KeyType::Kind::word && type.shown.empty();
  if (!type.other.empty() && !names_other) text += fmt::format(" or {}", type.other);
  if (!type.by.empty()) text = fmt::format("{{ {} = {} }}", type.by, text);
  if (!type.unit.empty()) text += fmt::format(", {}", type.unit);
  return text;
}

}  // namespace taut::cli
