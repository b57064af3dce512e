#include <algorithm>

#include <fmt/format.h>

#include "cli/drawing/keys.hpp"
#include "cli/scene/sections.hpp"

namespace taut::cli {
namespace {

using Kind = TomlValue::Kind;

TomlValue toml_of(const DrawingKey& key, const DrawingValue& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return TomlValue(*word);
  TomlValue array;
  array.kind = Kind::array;
  for (const double number : std::get<std::vector<double>>(value))
    array.items.emplace_back(number).whole = key.numbers.whole;
  return key.numbers.count == 1 ? array.items.front() : array;
}

/// What the file has for a key; the word for a key that takes words, and for what is left open.
DrawingValue given(TomlCursor& render, const DrawingKey& key) {
  if (key.takes_words()) return render.text(key.name);
  const TomlValue& value = render.need(key.name);
  if (key.may_be_open) {
    if (value.kind == Kind::text && value.text == automatic) return value.text;
    if (value.kind != Kind::array)
      render.fail(value, key.name,
                  fmt::format("{} must be \"{}\" or {}, this is {}", key.name, automatic, key.numbers.in_file,
                              value.kind_name()));
  }
  if (key.numbers.count == 1) return std::vector{render.number(key.name)};
  return render.numbers(key.name, key.numbers.count);
}

void check_name(TomlCursor& render, const DrawingKey& key, const std::string& name) {
  std::vector<std::string> known = key.words.names();
  if (key.may_be_open) known.emplace(known.begin(), automatic);
  if (std::ranges::find(known, name) == known.end())
    render.fail_unknown(render.need(key.name), key.name, key.words.kind, name, known);
}

void read_key(TomlCursor& render, const DrawingKey& key, Drawing& drawing) {
  if (!render.find(key.name)) render.table().set(key.name, toml_of(key, key.get(drawing)));
  const DrawingValue value = given(render, key);
  if (key.takes_words()) check_name(render, key, std::get<std::string>(value));
  if (const std::string wrong = key.set(drawing, value); !wrong.empty())
    render.fail(render.need(key.name), key.name, wrong);
}

}  // namespace

void read_drawing(TomlCursor& root, Drawing& drawing) {
  TomlCursor render = root.section("render", "[render]");
  // names first: in this order missing keys are added, and errors list what is known
  for (const bool words : {true, false})
    for (const DrawingKey& key : drawing_keys())
      if (key.takes_words() == words) read_key(render, key, drawing);
  render.finish();
}

TomlValue drawing_table(const Drawing& drawing) {
  TomlValue table;
  table.section = true;
  for (const DrawingKey& key : drawing_keys()) table.set(key.name, toml_of(key, key.get(drawing)));
  return table;
}

}  // namespace taut::cli
