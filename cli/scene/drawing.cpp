#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "cli/drawing/keys.hpp"
#include "cli/drawing/page_keys.hpp"
#include "cli/scene/sections.hpp"
#include "cli/text/print_size.hpp"
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

DrawingValue given(TomlCursor& render, const DrawingKey& key) {
  if (key.takes_words() || key.is_free_text) return render.text(key.name);
  const TomlValue& value = render.need(key.name);
  if (key.allows_auto) {
    if (value.kind == Kind::text && value.text == automatic) return value.text;
    if (key.numbers.count > 1 && value.kind != Kind::array)
      render.fail(value, key.name,
                  fmt::format("{} must be \"{}\" or {}, not {}", key.name, automatic, key.numbers.in_file,
                              value.kind_name()));
  }
  if (key.numbers.count == 1) return std::vector{render.value_of(value, key.name)};
  return render.numbers(key.name, key.numbers.count);
}

void check_name(TomlCursor& render, const DrawingKey& key, const std::string& name) {
  if (key.allows_auto && name == automatic) return;
  std::vector<std::string> known = key.words.names();
  if (key.allows_auto) known.emplace(known.begin(), automatic);
  if (const auto unknown = key.words.first_unknown(name))
    render.fail_unknown(render.need(key.name), key.name, key.words.kind, *unknown, known);
}

void read_key(TomlCursor& render, const DrawingKey& key, Drawing& drawing) {
  if (!render.find(key.name)) render.table().set(key.name, toml_of(key, key.get(drawing)));
  const DrawingValue value = given(render, key);
  if (key.takes_words()) check_name(render, key, std::get<std::string>(value));
  if (const std::string wrong = key.set(drawing, value); !wrong.empty())
    render.fail(render.need(key.name), key.name, wrong);
}

struct Mismatch {
  std::vector<std::string_view> keys;
  std::string what;
};

std::optional<Mismatch> misfit(const Drawing& drawing) {
  const render::Look look = sized(drawing).look;
  if (const auto wide = pixels_on_paper(drawing); wide && !(*wide <= render::greatest_size))
    return Mismatch{
        {"width", "dpi"},
        fmt::format(
            "a width of {} at {:g} dpi is {:.0f} pixels; at most {} are allowed; use a smaller width or dpi",
            drawing.print_width, drawing.dpi.value_or(print_dpi), *wide, render::greatest_size)};
  if (!look.size) return std::nullopt;
  const auto [width, height] = *look.size;
  if (std::min(width, height) < render::least_size || std::max(width, height) > render::greatest_size)
    return Mismatch{{"width", "dpi"},
                    fmt::format("width, dpi and size give {}x{} pixels; each must be from {} to {}", width,
                                height, render::least_size, render::greatest_size)};
  constexpr double least_em = 10;  // smallest side, in font sizes
  if (const double font = look.texts.font;
      !look.bare && font > 0 && std::min(width, height) < least_em * font)
    return Mismatch{{"font_size", "width"},
                    fmt::format("texts of {:.0f} pixels are too large for a picture of {}x{} pixels; "
                                "use a smaller font_size or a larger picture",
                                font, width, height)};
  return std::nullopt;
}

std::optional<Mismatch> mismatch(const Drawing& drawing, const Scene& scene) {
  const bool flat = scene.dim == 2;
  if (drawing.formula.empty() && drawing.field->least_dim > scene.dim)
    return Mismatch{{"color"}, unknown_name("field", drawing.field->key, names_of_fields(scene.dim))};
  if (flat && drawing.look.camera)
    return Mismatch{
        {"camera", "up", "fov"},
        "camera, up and fov need dim = 3, but this scene has dim = 2; remove them and use `view`"};
  if (!flat && drawing.look.view)
    return Mismatch{{"view"},
                    "view needs dim = 2, but this scene has dim = 3; remove it or set it to auto, "
                    "and use `camera`, `up` and `fov`. Pictures in 3D show the whole motion"};
  if (drawing.style == (flat ? Style::spheres : Style::discs))
    return Mismatch{
        {"style"},
        flat ? "style = \"spheres\" needs dim = 3, but this scene has dim = 2; use discs, cells or surface"
             : "style = \"discs\" needs dim = 2, but this scene has dim = 3; use spheres, cells or surface"};
  if ((drawing.style == Style::cells || drawing.style == Style::surface) && drawing.look.glyph != 1)
    return Mismatch{
        {"glyph"},
        fmt::format("glyph is the size of round particles and cannot be used with style = \"{}\"; "
                    "remove one of them",
                    drawing.style == Style::cells ? "cells" : "surface")};
  if (!flat && drawing.outline != Outlines::none)
    return Mismatch{{"outline"}, "outline needs dim = 2, but this scene has dim = 3; remove it"};
  if (flat && drawing.look.texts.axes_outside)
    return Mismatch{{"axes_position"}, "axes_position needs dim = 3, but this scene has dim = 2; remove it"};
  if (drawing.formula.empty() && drawing.field->counts != Counted::nothing &&
      (drawing.look.range || drawing.look.colormap))
    return Mismatch{{"range", "colormap"},
                    fmt::format("range and colormap need a field of numbers, "
                                "but color = \"{0}\" has one colour for each {0}; remove them",
                                drawing.field->key)};
  if (auto wrong = misfit(drawing)) return wrong;
  const std::vector<std::string> bodies = names_of(scene.bodies);
  if (!drawing.follow.empty() && std::ranges::find(bodies, drawing.follow) == bodies.end())
    return Mismatch{{"follow"}, unknown_name("body", drawing.follow, bodies)};
  const std::vector<std::string> hidden = split_at_commas(drawing.hide);
  for (const std::string& name : hidden)
    if (std::ranges::find(bodies, name) == bodies.end())
      return Mismatch{{"hide"}, unknown_name("body", name, bodies)};
  if (std::ranges::all_of(bodies,
                          [&](const std::string& name) { return std::ranges::count(hidden, name) > 0; }))
    return Mismatch{{"hide"}, fmt::format("hide = \"{}\" hides all bodies; hide fewer", drawing.hide)};
  return std::nullopt;
}

/// Smallest significant difference in the field's unit; 0: any.
double round_off(const Field& field, const Scene& scene) {
  constexpr double strain = 1e-9, in_single_precision = 1e-6;  // relative
  double stiffest = 0;                                         // Pa
  for (const Material& material : scene.materials) stiffest = std::max(stiffest, material.youngs_modulus);
  if (field.unit == "Pa") return strain * stiffest;
  if (field.unit == "m") return strain * scene.spacing;
  return field.unit.empty() ? strain + in_single_precision * std::abs(field.middle) : 0;
}

/// Materials that only hidden bodies or no bodies have.
std::vector<int> unseen_materials(const Scene& scene, const std::vector<int>& hidden) {
  std::vector<bool> seen(scene.materials.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (std::ranges::count(hidden, static_cast<int>(b)) > 0) continue;
    const Body& body = scene.bodies[b];
    seen[static_cast<std::size_t>(body.material)] = true;
    for (const Part& part : body.parts) seen[static_cast<std::size_t>(part.material)] = true;
  }
  std::vector<int> unseen;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (!seen[k]) unseen.push_back(static_cast<int>(k));
  return unseen;
}

void fill_from_scene(Drawing& drawing, const Scene& scene) {
  drawing.hidden.clear();
  for (const std::string& name : split_at_commas(drawing.hide))
    drawing.hidden.push_back(static_cast<int>(index_of(scene.bodies, name)));
  drawing.look.categories.clear();
  drawing.look.unlisted.clear();
  const Counted counted = drawing.formula.empty() ? drawing.field->counts : Counted::nothing;
  if (counted == Counted::bodies)
    drawing.look.categories = names_of(scene.bodies), drawing.look.unlisted = drawing.hidden;
  if (counted == Counted::materials)
    drawing.look.categories = names_of(scene.materials),
    drawing.look.unlisted = unseen_materials(scene, drawing.hidden);
  if (scene.dim == 3 && !drawing.look.camera) drawing.look.camera.emplace();
  drawing.walls.clear();
  for (const Wall& wall : scene.walls) drawing.walls.push_back({wall.at, wall.normal});
  drawing.round_off = drawing.formula.empty() ? round_off(*drawing.field, scene) : 0;
  drawing.followed.reset();
  const bool needs_scene = drawing.style == Style::surface || drawing.outline != Outlines::none;
  drawing.scene = needs_scene ? std::make_shared<const Scene>(scene) : nullptr;
  if (!drawing.follow.empty()) drawing.followed = static_cast<int>(index_of(scene.bodies, drawing.follow));
}

/// Throws ExpressionError.
ColorFormula color_formula(const std::string& text, int dim, const Names& names) {
  const auto& others = ColorFormula::places;
  std::vector<std::string> all = names_of_fields(dim);
  all.insert(all.end(), others.begin(), others.end());
  compile_of_values(text, names, all);
  ColorFormula formula;
  std::vector<std::string> needed;
  for (const std::string& name : names_in(text)) {
    const Field* field = find_field(name, dim);
    if (!field) continue;
    formula.fields.push_back(field);
    needed.push_back(name);
  }
  needed.insert(needed.end(), others.begin(), others.end());
  formula.function = compile_of_values(text, names, needed);
  return formula;
}

void read_formula(TomlCursor& render, const Scene& scene, Drawing& drawing) {
  try {
    drawing.of_formula = color_formula(drawing.formula, scene.dim, render.names());
    render.mark_names_used(drawing.formula);
  } catch (const ExpressionError& error) {
    render.fail(render.need("color"), "color", error.what());
  }
}

}  // namespace

void apply_scene(Drawing& drawing, const SceneFile& file) {
  if (const auto wrong = mismatch(drawing, file.scene)) throw UsageError(wrong->what);
  fill_from_scene(drawing, file.scene);
  drawing.is_cut = {};
  drawing.of_formula = {};
  Names names{{"dp", file.scene.spacing}};
  for (const Parameter& parameter : file.parameters) names.emplace(parameter.name, parameter.value);
  const auto with_key = [](std::string_view key, const auto& read) {
    try {
      read();
    } catch (const ExpressionError& error) {
      throw UsageError(fmt::format("{}: {}", key, error.what()));
    }
  };
  if (file.scene.dim == 2 && !names.contains("z") && names_in(drawing.cut).contains("z"))
    throw UsageError(fmt::format("cut = '{}' uses z, but the scene has dim = 2; use x and y", drawing.cut));
  if (!drawing.cut.empty()) with_key("cut", [&] { drawing.is_cut = compile(drawing.cut, names); });
  if (!drawing.formula.empty())
    with_key("color", [&] { drawing.of_formula = color_formula(drawing.formula, file.scene.dim, names); });
}

void read_drawing(TomlCursor& root, const Scene& scene, Drawing& drawing) {
  TomlCursor render = root.section("render", "[render]", keys_of("render"));
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
  fill_from_scene(drawing, scene);
  if (!drawing.cut.empty()) drawing.is_cut = render.function_of(render.need("cut"), "cut");
  if (!drawing.formula.empty()) read_formula(render, scene, drawing);
  render.finish();
}

DrawingValues read_drawing_values(TomlCursor& render) {
  DrawingValues values;
  Drawing drawing;
  for (const bool words : {true, false})
    for (const DrawingKey& key : drawing_keys()) {
      if (key.takes_words() != words || !render.find(key.name)) continue;
      read_key(render, key, drawing);
      values.emplace(key.name, given(render, key));
    }
  return values;
}

TomlValue drawing_table(const Drawing& drawing) {
  TomlValue table;
  table.section = true;
  for (const DrawingKey& key : drawing_keys()) table.set(key.name, toml_of(key, key.get(drawing)));
  return table;
}

}  // namespace taut::cli
