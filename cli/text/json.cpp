#include "cli/text/json.hpp"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Library = nlohmann::ordered_json;
using Event = nlohmann::detail::parse_event_t;

struct ToLibrary {
  Library operator()(std::monostate) const { return nullptr; }
  Library operator()(const std::vector<Json>& items) const {
    Library array = Library::array();
    for (const Json& item : items) array.push_back(std::visit(*this, item.value()));
    return array;
  }
  Library operator()(const std::vector<Json::Member>& members) const {
    Library object = Library::object();
    for (const auto& [key, value] : members) object.emplace(key, std::visit(*this, value.value()));
    return object;
  }
  Library operator()(const auto& plain) const { return plain; }
};

Json from_library(const Library& value) {
  switch (value.type()) {
    case Library::value_t::boolean:
      return value.get<bool>();
    case Library::value_t::number_integer:
      return value.get<std::int64_t>();
    case Library::value_t::number_unsigned:
      return value.get<std::uint64_t>();
    case Library::value_t::number_float:
      return value.get<double>();
    case Library::value_t::string:
      return value.get<std::string>();
    case Library::value_t::array: {
      Json array = Json::array();
      for (const Library& item : value) array.add(from_library(item));
      return array;
    }
    case Library::value_t::object: {
      Json object = Json::object();
      for (const auto& [key, member] : value.items()) object[key] = from_library(member);
      return object;
    }
    default:
      return nullptr;
  }
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw UsageError("'" + file + "' " + what);
}

/// Rejects repeated keys and deep nesting.
class Watch {
 public:
  explicit Watch(const std::string& file) : file_(file) {}

  bool operator()(int depth, Event event, const Library& value) {
    constexpr int deepest = 64;
    if (depth > deepest) refuse(file_, "is nested more than 64 levels deep, unlike any file of taut");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key && !keys_.back().insert(value.get<std::string>()).second)
      refuse(file_, "has the key '" + shown(value.get<std::string>(), 60) + "' twice");
    return true;
  }

 private:
  const std::string& file_;
  std::vector<std::set<std::string>> keys_;  // of the open objects
};

}  // namespace

Json::Json(std::optional<double> value) {
  if (value) value_ = *value;
}

Json::Json(const std::vector<std::string>& texts) : value_(std::vector<Json>(texts.begin(), texts.end())) {}

Json::Json(std::initializer_list<Member> members) : value_(std::vector<Member>(members)) {}

Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json::~Json() = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;

Json Json::array() { return std::vector<std::string>(); }

bool Json::operator==(const Json& other) const { return value_ == other.value_; }

bool Json::is_number() const {
  return is_float() || std::holds_alternative<std::int64_t>(value_) ||
         std::holds_alternative<std::uint64_t>(value_);
}

double Json::number() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*whole);
  return std::get<double>(value_);
}

const Json* Json::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  const auto found = std::ranges::find(members(), key, &Member::first);
  return found == members().end() ? nullptr : &found->second;
}

Json& Json::operator[](std::string_view key) {
  if (is_null()) value_.emplace<std::vector<Member>>();
  auto& members = std::get<std::vector<Member>>(value_);
  const auto found = std::ranges::find(members, key, &Member::first);
  return found == members.end() ? members.emplace_back(key, nullptr).second : found->second;
}

void Json::add(Json item) {
  if (is_null()) value_.emplace<std::vector<Json>>();
  std::get<std::vector<Json>>(value_).push_back(std::move(item));
}

Json Json::with(const Json& other) const {
  Json both = *this;
  for (const auto& [key, value] : other.members())
    if (!find(key)) both[key] = value;
  return both;
}

std::string Json::dump(int indent) const {
  return std::visit(ToLibrary(), value_).dump(indent, ' ', false, Library::error_handler_t::replace);
}

std::vector<Json::Member> Json::leaves() const {
  std::vector<Member> leaves;
  const Library flat = std::visit(ToLibrary(), value_).flatten();
  for (const auto& [pointer, value] : flat.items()) leaves.emplace_back(pointer, from_library(value));
  return leaves;
}

Json parse_json(const std::string& text, const std::string& file) {
  try {
    return from_library(Library::parse(text, Watch(file)));
  } catch (const Library::exception& error) {
    const std::string what = error.what();  // "[json.exception.parse_error.101] parse error at …"
    refuse(file, "is not JSON: " + shown(what.substr(std::min(what.find("] "), what.size() - 2) + 2)));
  }
}

Json number_or_text(const std::string& text) {
  const Library number = Library::parse(text, nullptr, /*allow_exceptions=*/false);
  return number.is_number() ? from_library(number) : Json(text);
}

}  // namespace taut::cli
