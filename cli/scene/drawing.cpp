#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "cli/drawing/keys.hpp"
#include "cli/scene/sections.hpp"
#include "cli/text/suggest.hpp"

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
  if (key.takes_words() || key.of_text) return render.text(key.name);
  const TomlValue& value = render.need(key.name);
  if (key.may_be_open) {
    if (value.kind == Kind::text && value.text == automatic) return value.text;
    if (key.numbers.count > 1 && value.kind != Kind::array)
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

/// A key that does not go with the scene, and why.
struct Mismatch {
  std::vector<std::string_view> keys;  // one of these
  std::string what;
};

std::optional<Mismatch> mismatch(const Drawing& drawing, const Scene& scene) {
  const bool flat = scene.dim == 2;
  if (flat && drawing.look.camera)
    return Mismatch{
        {"camera", "up", "fov"},
        "camera, up and fov are for scenes in 3D, this one has dim = 2: leave them out; `view` says "
        "what is seen"};
  if (!flat && drawing.look.view)
    return Mismatch{
        {"view"},
        "view is for scenes in 2D, this one has dim = 3: leave it out, or auto; `camera`, `up` and "
        "`fov` say from where it is seen, and the whole motion is in the picture"};
  if (drawing.style == (flat ? Style::spheres : Style::discs))
    return Mismatch{
        {"style"},
        flat ? "style = \"spheres\" is for scenes in 3D, this one has dim = 2: take discs or cells"
             : "style = \"discs\" is for scenes in 2D, this one has dim = 3: take spheres or cells"};
  const std::vector<std::string> bodies = names_of(scene.bodies);
  if (!drawing.follow.empty() && std::ranges::find(bodies, drawing.follow) == bodies.end())
    return Mismatch{{"follow"}, unknown_name("body", drawing.follow, bodies)};
  return std::nullopt;
}

/// What the scene settles; there is no mismatch.
void settle(Drawing& drawing, const Scene& scene) {
  if (scene.dim == 3 && !drawing.look.camera) drawing.look.camera.emplace();
  drawing.followed.reset();
  if (!drawing.follow.empty()) drawing.followed = static_cast<int>(index_of(scene.bodies, drawing.follow));
}

}  // namespace

void suit(Drawing& drawing, const SceneFile& file) {
  if (const auto wrong = mismatch(drawing, file.scene)) throw UsageError(wrong->what);
  settle(drawing, file.scene);
  drawing.is_cut = {};
  if (drawing.cut.empty()) return;
  Names names{{"dp", file.scene.spacing}};
  for (const Parameter& parameter : file.parameters) names.emplace(parameter.name, parameter.value);
  try {
    drawing.is_cut = compile(drawing.cut, names);
  } catch (const ExpressionError& error) {
    throw UsageError("cut: " + std::string(error.what()));
  }
}

void read_drawing(TomlCursor& root, const Scene& scene, Drawing& drawing) {
  TomlCursor render = root.section("render", "[render]", keys_of("render"));
  // names first: in this order missing keys are added, and errors list what is known
  for (const bool words : {true, false})
    for (const DrawingKey& key : drawing_keys())
      if (key.takes_words() == words) read_key(render, key, drawing);
  if (const auto wrong = mismatch(drawing, scene)) {
    const auto given = std::ranges::find_if(wrong->keys, [&](std::string_view key) {
      const TomlValue& value = render.need(key);
      return value.kind != Kind::text || value.text != automatic;
    });
    render.fail(render.need(*given), *given, wrong->what);
  }
  settle(drawing, scene);
  if (!drawing.cut.empty()) drawing.is_cut = render.function_of(render.need("cut"), "cut");
  render.finish();
}

TomlValue drawing_table(const Drawing& drawing) {
  TomlValue table;
  table.section = true;
  for (const DrawingKey& key : drawing_keys()) table.set(key.name, toml_of(key, key.get(drawing)));
  return table;
}

}  // namespace taut::cli
