#include "cli/scene/toml_cursor.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using Kind = TomlValue::Kind;

std::string place_text(const Point& x) {
  return fmt::format("({}, {}, {})", exact(x[0]), exact(x[1]), exact(x[2]));
}

std::string time_text(double t) { return fmt::format("t = {} s", exact(t)); }

std::optional<TomlValue> default_value(const KeyInfo& row) {
  const KeyType& type = row.type;
  if (type.kind == KeyType::Kind::word && type.form == KeyType::Form::one) {
    const std::vector<std::string> words = words_of(type);
    if (std::ranges::find(words, row.by_default) != words.end())
      return TomlValue(std::string(row.by_default));
  }
  if (type.kind != KeyType::Kind::number && type.kind != KeyType::Kind::whole) return {};
  const std::optional<double> number = default_number(row);
  if (!number) return {};
  TomlValue value(*number);
  value.whole = type.kind == KeyType::Kind::whole;
  return value;
}

}  // namespace

bool is_identifier(std::string_view name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !name.empty() && !std::isdigit(static_cast<unsigned char>(name.front())) &&
         std::all_of(name.begin(), name.end(), fits);
}

TomlCursor::TomlCursor(TomlValue& table, std::string path, std::string what, std::span<const KeyInfo> keys,
                       Names names, TomlSource& source)
    : table_(table),
      path_(std::move(path)),
      what_(std::move(what)),
      names_(std::move(names)),
      source_(source) {
  also_takes(keys);
}

void TomlCursor::also_takes(std::span<const KeyInfo> keys) {
  rows_.insert(rows_.end(), keys.begin(), keys.end());
}

const KeyInfo* TomlCursor::row(std::string_view key) const {
  const auto found =
      std::ranges::find_if(rows_, [=](const KeyInfo& k) { return k.name == key || k.name == any_name; });
  return found == rows_.end() ? nullptr : &*found;
}

TomlValue* TomlCursor::find(std::string_view key) {
  if (row(key) == nullptr)
    throw std::logic_error(fmt::format("the table of keys of {} lacks '{}'", what_, key));
  TomlEntry* entry = table_.find(key);
  if (!entry) return nullptr;
  entry->known = true;
  return &entry->value;
}

TomlValue& TomlCursor::need(std::string_view key) {
  if (TomlValue* value = find(key)) return *value;
  if (std::optional<TomlValue> usual = default_value(*row(key))) {
    table_.set(key, *std::move(usual));
    return *find(key);
  }
  std::vector<std::string> others;
  for (const TomlEntry& entry : table_.entries)
    if (row(entry.key) == nullptr) others.push_back(entry.key);
  std::vector<std::string> near = nearest(key, others);
  if (near.empty() && others.size() == 1) near = others;
  const FilePlace place = near.empty() ? table_.place : table_.find(near.front())->place;
  fail(place, key,
       fmt::format("'{}' is missing in {}{}", key, what_,
                   near.empty() ? "" : fmt::format("; the unknown key '{}' may be meant", near.front())));
}

std::string TomlCursor::text(std::string_view key) { return text_of(need(key), key); }

std::string TomlCursor::text(std::string_view key, std::string_view otherwise) {
  if (!find(key)) table_.set(key, TomlValue(std::string(otherwise)));
  return text(key);
}

std::string TomlCursor::line(std::string_view key) {
  constexpr std::size_t longest = 200;
  const std::string given = text(key);
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
  if (given.size() > longest)
    fail(*find(key), key, fmt::format("{} has {} bytes; at most {} are allowed", key, given.size(), longest));
  if (std::ranges::any_of(given, is_control) || !is_utf8(given))
    fail(*find(key), key, fmt::format("{} must be one line of UTF-8 text, not '{}'", key, shown(given)));
  return given;
}

std::string TomlCursor::line(std::string_view key, std::string_view otherwise) {
  if (!find(key)) table_.set(key, TomlValue(std::string(otherwise)));
  return line(key);
}

std::string TomlCursor::choice(std::string_view key) {
  need(key);
  return choice(key, words_of(row(key)->type));
}

std::string TomlCursor::choice(std::string_view key, const std::vector<std::string>& allowed) {
  const std::string given = text(key);
  if (std::find(allowed.begin(), allowed.end(), given) == allowed.end())
    fail_unknown(*find(key), key, std::string(key), given, allowed);
  return given;
}

void TomlCursor::check_bounds(const TomlValue& value, std::string_view key, std::string_view shown,
                              double number) const {
  if (const std::string wrong = against_bounds(row(key)->type, number); !wrong.empty())
    fail(value, key, fmt::format("{} = {} {}", shown, exact(number), wrong));
}

double TomlCursor::number(std::string_view key) {
  const TomlValue& value = need(key);
  const double number = value_of(value, key);
  check_bounds(value, key, key, number);
  return number;
}

double TomlCursor::number(std::string_view key, double otherwise) {
  if (!find(key)) table_.set(key, TomlValue(otherwise));
  return number(key);
}

int TomlCursor::whole(std::string_view key) { return static_cast<int>(number(key)); }

bool TomlCursor::flag(std::string_view key) {
  const TomlValue* value = find(key);
  if (value && value->kind != Kind::boolean)
    fail(*value, key, fmt::format("{} must be true or false, not {}", key, value->kind_name()));
  return value && value->flag;
}

std::vector<double> TomlCursor::numbers(std::string_view key, std::size_t size) {
  const TomlValue& value = need(key);
  if (value.kind != Kind::array || value.items.size() != size)
    fail(value, key,
         fmt::format("{} must be an array of {} numbers, not {}", key, size,
                     value.kind == Kind::array ? fmt::format("an array of {}", value.items.size())
                                               : std::string(value.kind_name())));
  std::vector<double> result;
  for (const TomlValue& item : value.items) {
    result.push_back(value_of(item, key));
    check_bounds(item, key, fmt::format("{}[{}]", key, result.size() - 1), result.back());
  }
  return result;
}

Point TomlCursor::point(std::string_view key, int dim) {
  Point result{};
  const std::vector<double> components = numbers(key, static_cast<std::size_t>(dim));
  std::copy(components.begin(), components.end(), result.begin());
  return result;
}

double TomlCursor::value_of(const TomlValue& value, std::string_view key) {
  double result = 0;
  if (value.kind == Kind::number) {
    result = value.number;
  } else if (value.kind == Kind::text) {
    try {
      result = evaluate(value.text, names_);
    } catch (const ExpressionError& error) {
      fail_expression(value, key, error);
    }
    mark_names_used(value.text);
  } else {
    fail(value, key, fmt::format("{} must be a number or an expression, not {}", key, value.kind_name()));
  }
  if (!std::isfinite(result))
    fail(value, key, fmt::format("{} is {}; it must be a finite number", key, exact(result)));
  return result;
}

template <class... Arguments, class Compile, class Show>
std::function<double(Arguments...)> TomlCursor::function(const TomlValue& value, std::string_view key,
                                                         const Compile& compile, const Show& show) {
  std::function<double(Arguments...)> function;
  if (value.kind != Kind::text) {
    const double constant = value_of(value, key);
    if (constant == 0) return {};
    return [constant](Arguments...) { return constant; };
  }
  try {
    function = compile(value.text, names_);
    if (names_in(value.text).empty() && evaluate(value.text, names_) == 0) return {};
  } catch (const ExpressionError& error) {
    fail_expression(value, key, error);
  }
  mark_names_used(value.text);
  const SceneError failure(source_.file, value.place.line, value.place.column, full_path(key), "");
  return [function, failure, show, name = std::string(key), text = value.text](Arguments... at) {
    const double result = function(at...);
    if (!std::isfinite(result))
      throw SceneError(failure.file, failure.line, failure.column, failure.key,
                       fmt::format("{} = '{}' is {} at {}; it must be a finite number", name, text,
                                   exact(result), show(at...)));
    return result;
  };
}

void TomlCursor::refuse_third_axis(const TomlValue& value, std::string_view key) const {
  if (source_.dim == 2 && value.kind == Kind::text && !names_.contains("z") &&
      names_in(value.text).contains("z"))
    fail(value, key,
         fmt::format("{} = '{}' uses z, but the scene has dim = 2; use x and y", key, value.text));
}

Expression TomlCursor::function_of(const TomlValue& value, std::string_view key) {
  refuse_third_axis(value, key);
  return function<const Point&>(value, key, compile, place_text);
}

std::function<double(double)> TomlCursor::function_of_time(const TomlValue& value, std::string_view key) {
  return function<double>(value, key, compile_of_time, time_text);
}

Solution TomlCursor::solution(const TomlValue& value, std::string_view key) {
  refuse_third_axis(value, key);
  const Solution solution = function<const Point&, double>(
      value, key, compile_in_time,
      [](const Point& x, double t) { return fmt::format("{}, {}", place_text(x), time_text(t)); });
  return solution ? solution : [](const Point&, double) { return 0.0; };
}

Solution TomlCursor::solution_of_time(const TomlValue& value, std::string_view key) {
  return
      [of_time = function_of_time(value, key)](const Point&, double t) { return of_time ? of_time(t) : 0; };
}

std::function<double(const std::vector<double>&, double)> TomlCursor::function_of_probes(
    const TomlValue& value, std::string_view key, const std::vector<std::string>& probes) {
  const std::string text = value.kind == Kind::text ? value.text : exact(value_of(value, key));
  for (const std::string& probe : probes)
    if (names_.contains(probe) && names_in(text).contains(probe))
      fail(value, key,
           fmt::format("'{}' is the name of a probe and of a number; give the probe another name", probe));
  try {
    mark_names_used(text);
    return compile_of_values(text, names_, probes);
  } catch (const ExpressionError& error) {
    fail_expression(value, key, error);
  }
}

std::string TomlCursor::text_of(const TomlValue& value, std::string_view key) {
  if (value.kind != Kind::text)
    fail(value, key, fmt::format("{} must be a text in quotes, not {}", key, value.kind_name()));
  return value.text;
}

TomlCursor TomlCursor::enter(TomlValue& value, std::string_view key, std::string what,
                             std::span<const KeyInfo> keys) {
  if (value.kind != Kind::table)
    fail(value, key, fmt::format("{} must be a table, not {}", what, value.kind_name()));
  return {value, full_path(key), std::move(what), keys, names_, source_};
}

TomlCursor TomlCursor::section(std::string_view key, std::string what, std::span<const KeyInfo> keys) {
  if (!find(key)) {
    TomlValue empty;
    empty.section = true;
    table_.set(key, std::move(empty));
  }
  return enter(*find(key), key, std::move(what), keys);
}

std::span<TomlValue> TomlCursor::list(std::string_view key) {
  TomlValue* value = find(key);
  if (!value) return {};
  if (value->kind != Kind::array)
    fail(*value, key, fmt::format("{0} must be written as [[{0}]], one block for each", key));
  return value->items;
}

void TomlCursor::fail(FilePlace place, std::string_view key, const std::string& message) const {
  throw SceneError(source_.file, place.line, place.column, full_path(key), message);
}

void TomlCursor::fail(const TomlValue& value, std::string_view key, const std::string& message) const {
  fail(value.place, key, message);
}

void TomlCursor::fail_unknown(const TomlValue& value, std::string_view key, std::string_view kind,
                              std::string_view given, const std::vector<std::string>& known) const {
  fail(value, key, unknown_name(kind, given, known));
}

void TomlCursor::fail_expression(const TomlValue& value, std::string_view key,
                                 const ExpressionError& error) const {
  FilePlace place = value.place;
  if (value.verbatim) place.column += 1 + static_cast<int>(std::min(error.offset, value.text.size()));
  fail(place, key, fmt::format("{}: {}", key, error.what()));
}

void TomlCursor::refuse_unknown_keys() const {
  for (const TomlEntry& entry : table_.entries) {
    if (row(entry.key) != nullptr) continue;
    std::vector<std::string> known;
    for (const KeyInfo& key : rows_) known.emplace_back(key.name);
    fail(entry.place, entry.key,
         fmt::format("unknown key '{}' in {}{}; known keys: {}", entry.key, what_,
                     did_you_mean(entry.key, known), join(known)));
  }
}

void TomlCursor::finish() const {
  refuse_unknown_keys();
  for (const TomlEntry& entry : table_.entries)
    if (!entry.known)
      fail(entry.place, entry.key, fmt::format("'{}' has no effect in {}; remove it", entry.key, what_));
}

void TomlCursor::mark_names_used(const std::string& text) { source_.used.merge(names_in(text)); }

std::string TomlCursor::full_path(std::string_view key) const {
  return fmt::format("{}{}{}", path_, path_.empty() || key.empty() ? "" : ".", key);
}

}  // namespace taut::cli
