#include "cli/text/json_cursor.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

const Json nothing;

}  // namespace

JsonCursor::JsonCursor(const Json& value, const std::string& file, std::string path, bool texts_are_numbers)
    : value_(&value), file_(&file), path_(std::move(path)), texts_are_numbers_(texts_are_numbers) {}

bool JsonCursor::is_null() const { return value_->is_null(); }

bool JsonCursor::is_missing() const { return value_ == &nothing; }

JsonCursor JsonCursor::at(const std::string& key) const {
  check_object();
  const Json* found = value_->find(key);
  return {found ? *found : nothing, *file_, path_.empty() ? key : fmt::format("{}.{}", path_, key),
          texts_are_numbers_};
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  std::vector<std::pair<std::string, JsonCursor>> all;
  if (is_null()) return all;
  check_object();
  for (const auto& member : value_->members()) all.emplace_back(member.first, at(member.first));
  return all;
}

std::vector<JsonCursor> JsonCursor::items() const {
  std::vector<JsonCursor> all;
  if (is_null() || (texts_are_numbers_ && value_->is_text())) return all;
  if (!value_->is_array()) fail("an array");
  for (const Json& item : value_->items())
    all.emplace_back(item, *file_, fmt::format("{}.{}", path_, all.size()), texts_are_numbers_);
  return all;
}

std::string JsonCursor::text() const {
  if (is_null()) return "";
  if (!value_->is_text()) fail("a text");
  return value_->text();
}

std::string JsonCursor::number_or_text() const {
  if (!value_->is_text() && !value_->is_number()) fail("a number or a text");
  return value_->is_text() ? value_->text() : value_->dump();
}

void JsonCursor::check_object() const {
  if (!value_->is_object()) fail("an object");
}

std::optional<double> JsonCursor::number() const {
  if (is_null()) return std::nullopt;
  if (texts_are_numbers_ && value_->is_text()) return parsed<double>(value_->text());
  if (!value_->is_number()) fail("a number");
  return value_->number();
}

std::string JsonCursor::choice(const std::vector<std::string>& allowed) const {
  if (is_null()) return "";
  const bool known = value_->is_text() && std::ranges::count(allowed, value_->text()) > 0;
  if (!known) fail("one of " + join(allowed));
  return value_->text();
}

void JsonCursor::fail(const std::string& allowed) const {
  const std::string is = shown(value_->dump(), 60);
  if (path_.empty()) throw UsageError(fmt::format("'{}' contains {}; it must be {}", *file_, is, allowed));
  throw UsageError(fmt::format("'{}': key '{}' is {}; it must be {}", *file_, shown(path_), is, allowed));
}

}  // namespace taut::cli
