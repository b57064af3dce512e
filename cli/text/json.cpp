#include "cli/text/json.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Library = nlohmann::ordered_json;

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

Json number_of(const Library& value) {
  switch (value.type()) {
    case Library::value_t::number_integer:
      return value.get<std::int64_t>();
    case Library::value_t::number_unsigned:
      return value.get<std::uint64_t>();
    case Library::value_t::number_float:
      return value.get<double>();
    default:
      return nullptr;
  }
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw UsageError(fmt::format("'{}' {}", file, what));
}

/// Rejects repeated keys and deep nesting.
class Builder final : public nlohmann::json_sax<Library> {
 public:
  explicit Builder(const std::string& file) : file_(file) {}

  Json take() && { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // never in JSON text
  bool start_object(std::size_t) override { return start(Json::object()); }
  bool start_array(std::size_t) override { return start(Json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(string_t& key) override {
    if (!open_.back().keys.insert(key).second)
      refuse(file_, fmt::format("has the key '{}' twice", shown(key, 60)));
    open_.back().key = std::move(key);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Library::exception& error) override {
    const std::string what = error.what();
    refuse(file_, "is not JSON: " + shown(what.substr(std::min(what.find("] "), what.size() - 2) + 2)));
  }

 private:
  struct Open {
    Json value;
    std::string key = {};
    std::set<std::string> keys = {};
  };

  bool start(Json value) {
    constexpr std::size_t deepest = 64;
    if (open_.size() == deepest) refuse(file_, "is nested more than 64 levels deep, unlike any file of taut");
    open_.push_back({std::move(value)});
    return true;
  }
  bool end() {
    Json value = std::move(open_.back().value);
    open_.pop_back();
    return put(std::move(value));
  }
  bool put(Json value) {
    if (open_.empty())
      root_ = std::move(value);
    else if (Open& outer = open_.back(); outer.value.is_array())
      outer.value.add(std::move(value));
    else
      outer.value.append(std::move(outer.key), std::move(value));
    return true;
  }

  const std::string& file_;
  Json root_;
  std::vector<Open> open_;
};

/// Escapes a key for a JSON pointer (RFC 6901), with a leading "/".
std::string pointer_part(std::string_view key) {
  std::string part = "/";
  for (const char c : key) part += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return part;
}

void add_leaves(const Json& value, const std::string& pointer, std::vector<Json::Member>& leaves) {
  if (value.is_object() && !value.members().empty()) {
    for (const auto& [key, member] : value.members()) add_leaves(member, pointer + pointer_part(key), leaves);
  } else if (value.is_array() && !value.items().empty()) {
    for (std::size_t k = 0; k < value.items().size(); ++k)
      add_leaves(value.items()[k], fmt::format("{}/{}", pointer, k), leaves);
  } else {
    leaves.emplace_back(pointer, value.is_object() || value.is_array() ? Json() : value);
  }
}

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

void Json::append(std::string key, Json value) {
  std::get<std::vector<Member>>(value_).emplace_back(std::move(key), std::move(value));
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
  add_leaves(*this, "", leaves);
  return leaves;
}

Json parse_json(const std::string& text, const std::string& file) {
  Builder builder(file);
  Library::sax_parse(text, &builder);
  return std::move(builder).take();
}

Json number_or_text(const std::string& text) {
  const Library number = Library::parse(text, nullptr, /*allow_exceptions=*/false);
  return number.is_number() ? number_of(number) : Json(text);
}

}  // namespace taut::cli
