#include "cli/drawing/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "cli/drawing/page_keys.hpp"
#include "cli/text/format.hpp"
#include "cli/text/print_size.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

DrawingValue get_color(const Drawing& drawing) {
  return drawing.formula.empty() ? std::string(drawing.field->key) : "=" + drawing.formula;
}

std::string set_color(Drawing& drawing, const DrawingValue& value) {
  const std::string& text = word(value);
  if (DrawingValue(text) == get_color(drawing)) return "";
  if (text.starts_with('=')) {
    if (text.size() == 1) return "color = \"=\" needs an expression after the sign, such as \"=speed^2/2\"";
    drawing.formula = text.substr(1);
  } else {
    drawing.field = &known_field(text);
    drawing.formula.clear();
  }
  drawing.look.range.reset();
  drawing.look.colormap = nullptr;
  return "";
}

std::string set_range(Drawing& drawing, const DrawingValue& value) {
  drawing.look.range.reset();
  if (is_word(value)) return "";
  const double low = numbers(value)[0], high = numbers(value)[1];
  if (!(low < high))
    return "range = [" + exact(low) + ", " + exact(high) + "]: the first number must be less than the second";
  drawing.look.range = {low, high};
  return "";
}

DrawingValue get_range(const Drawing& drawing) {
  const auto& range = drawing.look.range;
  return range ? Numbers{range->low, range->high} : left_open();
}

std::vector<std::string> names_of_colormaps() {
  std::vector<std::string> names;
  for (const render::Colormap& map : render::colormaps()) names.emplace_back(map.key);
  return names;
}

std::string set_colormap(Drawing& drawing, const DrawingValue& value) {
  drawing.look.colormap = render::find_colormap(word(value));  // null for "auto"
  return "";
}

DrawingValue get_colormap(const Drawing& drawing) {
  const render::Colormap* map = drawing.look.colormap;
  return map ? std::string(map->key) : left_open();
}

std::string set_view(Drawing& drawing, const DrawingValue& value) {
  drawing.look.view.reset();
  if (is_word(value)) return "";
  const Numbers& ends = numbers(value);
  if (!(ends[0] < ends[1]) || !(ends[2] < ends[3]))
    return "view = [x_min, x_max, y_min, y_max] needs x_min < x_max and y_min < y_max";
  drawing.look.view = {ends[0], ends[1], ends[2], ends[3]};
  return "";
}

DrawingValue get_view(const Drawing& drawing) {
  const auto& view = drawing.look.view;
  return view ? Numbers{view->x_min, view->x_max, view->y_min, view->y_max} : left_open();
}

std::string set_glyph(Drawing& drawing, const DrawingValue& value) {
  using render::least_glyph, render::greatest_glyph;
  const double times = numbers(value)[0];
  if (!(times >= least_glyph && times <= greatest_glyph))
    return number_out_of_bounds("glyph", times,
                                fmt::format("from {} to {} diameters", least_glyph, greatest_glyph));
  drawing.look.glyph = times;
  return "";
}

DrawingValue get_glyph(const Drawing& drawing) { return Numbers{drawing.look.glyph}; }

std::string set_frames(Drawing& drawing, const DrawingValue& value) {
  const double count = numbers(value)[0];
  if (!is_whole_within(count, 1, most_frames))
    return fmt::format("frames = {} must be a whole number from 1 to {}", exact(count), most_frames);
  drawing.frames = static_cast<int>(count);
  return "";
}

DrawingValue get_frames(const Drawing& drawing) { return Numbers{static_cast<double>(drawing.frames)}; }

render::Camera& camera_of(Drawing& drawing) {
  auto& camera = drawing.look.camera;
  return camera ? *camera : camera.emplace();
}

template <render::Vector render::Camera::*Way>
std::string set_way(Drawing& drawing, const DrawingValue& value) {
  const render::Vector by_default = render::Camera{}.*Way;
  if (is_word(value)) {
    if (drawing.look.camera) *drawing.look.camera.*Way = by_default;
    return "";
  }
  const Numbers& given = numbers(value);
  const render::Vector way{given[0], given[1], given[2]};
  constexpr double least_length = 1e-100;  // its square does not vanish
  if (!(std::hypot(way[0], way[1], way[2]) >= least_length))
    return "a direction cannot be [0, 0, 0], nor shorter than 1e-100";
  camera_of(drawing).*Way = way;
  return "";
}

template <render::Vector render::Camera::*Way>
DrawingValue get_way(const Drawing& drawing) {
  const auto& camera = drawing.look.camera;
  if (!camera) return left_open();
  const render::Vector& way = *camera.*Way;
  return Numbers(way.begin(), way.end());
}

std::string set_fov(Drawing& drawing, const DrawingValue& value) {
  if (is_word(value)) {
    if (drawing.look.camera) drawing.look.camera->field_of_view = 0;
    return "";
  }
  const double angle = numbers(value)[0];
  if (!(angle >= 0 && angle <= render::greatest_field_of_view))
    return number_out_of_bounds(
        "fov", angle, fmt::format("from 0 (parallel) to {} degrees", render::greatest_field_of_view));
  camera_of(drawing).field_of_view = angle;
  return "";
}

DrawingValue get_fov(const Drawing& drawing) {
  const auto& camera = drawing.look.camera;
  return camera ? Numbers{camera->field_of_view} : left_open();
}

// in enumerator order
constexpr std::array<std::string_view, 4> style_names{"discs", "spheres", "cells", "surface"};
constexpr std::array<std::string_view, 4> outline_names{"none", "deformed", "undeformed", "both"};

std::vector<std::string> names_of_styles() { return {style_names.begin(), style_names.end()}; }

std::string set_style(Drawing& drawing, const DrawingValue& value) {
  drawing.style.reset();
  const auto place = std::ranges::find(style_names, word(value));
  if (place != style_names.end()) drawing.style = static_cast<Style>(place - style_names.begin());
  return "";
}

DrawingValue get_style(const Drawing& drawing) {
  if (!drawing.style) return left_open();
  return std::string(style_names[static_cast<std::size_t>(*drawing.style)]);
}

std::vector<std::string> names_of_outlines() { return {outline_names.begin(), outline_names.end()}; }

std::string set_outline(Drawing& drawing, const DrawingValue& value) {
  const auto place = std::ranges::find(outline_names, word(value));
  drawing.outline = static_cast<Outlines>(place - outline_names.begin());
  return "";
}

DrawingValue get_outline(const Drawing& drawing) {
  return std::string(outline_names[static_cast<std::size_t>(drawing.outline)]);
}

template <std::string Drawing::*Text>
std::string set_text(Drawing& drawing, const DrawingValue& value) {
  drawing.*Text = word(value) == nothing ? "" : word(value);
  return "";
}

template <std::string Drawing::*Text>
DrawingValue get_text(const Drawing& drawing) {
  const std::string& text = drawing.*Text;
  return text.empty() ? std::string(nothing) : text;
}

std::optional<Numbers> typed_numbers(const DrawingKey::Numbers& key, std::string_view text) {
  Numbers values;
  for (std::size_t k = 0; k < key.count; ++k) {
    const std::size_t end = k + 1 < key.count ? text.find(key.between) : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view part = text.substr(0, end);
    const auto value = key.whole ? std::optional<double>(parsed<int>(part)) : parsed<double>(part);
    if (!value || !(*value >= key.low && *value <= key.high)) return std::nullopt;
    values.push_back(*value);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return values;
}

/// nullopt for wrong numbers. Throws UsageError for unknown words.
std::optional<DrawingValue> typed_value(const DrawingKey& key, const std::string& text) {
  if (text == automatic && key.placeholder.ends_with("|auto")) return left_open();
  if (key.is_free_text) return text;
  if (!key.takes_words()) return typed_numbers(key.numbers, text);
  if (const auto unknown = key.words.first_unknown(text))
    throw UsageError(unknown_name(key.words.kind, *unknown, key.words.names()));
  return text;
}

}  // namespace

std::span<const DrawingKey> drawing_keys() {
  static const std::array table{
      DrawingKey{
          .name = "color",
          .placeholder = "FIELD|=EXPRESSION",
          .help = "field that colours the particles (`taut list fields`), or an expression of fields, "
                  "such as '=speed^2/2'",
          .session_help =
              "field that colours the particles (`taut list fields`), or = and an expression of fields",
          .words = {"field", names_of_fields, true},
          .numbers = {.typed = "a field, or = and an expression of fields"},
          .set = set_color,
          .get = get_color},
      DrawingKey{.name = "range",
                 .placeholder = "LOW:HIGH|auto",
                 .help = "values at the ends of the colour scale, in the field's unit; auto: "
                         "the range of the whole sequence, without outliers",
                 .session_help = "values at the ends of the colour scale, in the field's unit; auto: "
                                 "the range at this time",
                 .allows_auto = true,
                 .numbers = {.count = 2,
                             .in_file = "[low, high]",
                             .typed = "LOW:HIGH with LOW < HIGH, such as 0:2e6, or 'auto'; "
                                      "both from -1e100 to 1e100"},
                 .set = set_range,
                 .get = get_range},
      DrawingKey{.name = "colormap",
                 .placeholder = "COLORMAP",
                 .help = "colour map (`taut list colormaps`); default: by the field",
                 .session_help = "colour map (`taut list colormaps`)",
                 .allows_auto = true,
                 .words = {"colour map", names_of_colormaps},
                 .set = set_colormap,
                 .get = get_colormap},
      DrawingKey{
          .name = "view",
          .placeholder = "X0:X1:Y0:Y1|auto",
          .help = "visible region, m; auto: the whole motion",
          .session_help = "visible region, m; fit: all particles at this time",
          .allows_auto = true,
          .numbers = {.count = 4,
                      .in_file = "[x_min, x_max, y_min, y_max]",
                      .typed = "X_MIN:X_MAX:Y_MIN:Y_MAX in metres, such as -0.1:0.1:0:0.05, or 'auto'; "
                               "all from -1e100 to 1e100"},
          .set = set_view,
          .get = get_view},
      DrawingKey{.name = "camera",
                 .placeholder = "X:Y:Z|auto",
                 .help = "3D: direction towards the camera; auto: 1:-2:1",
                 .session_help = "3D: direction towards the camera",
                 .allows_auto = true,
                 .numbers = {.count = 3,
                             .in_file = "[x, y, z]",
                             .typed = "X:Y:Z, a direction towards the camera such as 1:-2:1, or 'auto'; "
                                      "its length from 1e-100 to 1e100"},
                 .set = set_way<&render::Camera::from>,
                 .get = get_way<&render::Camera::from>},
      DrawingKey{.name = "up",
                 .placeholder = "X:Y:Z|auto",
                 .help = "3D: direction that points up in the picture; auto: 0:0:1",
                 .session_help = "3D: direction that points up in the picture",
                 .allows_auto = true,
                 .numbers = {.count = 3,
                             .in_file = "[x, y, z]",
                             .typed = "X:Y:Z, a direction that points up such as 0:0:1, or 'auto'; "
                                      "its length from 1e-100 to 1e100"},
                 .set = set_way<&render::Camera::up>,
                 .get = get_way<&render::Camera::up>},
      DrawingKey{.name = "fov",
                 .placeholder = "DEGREES|auto",
                 .help = "3D: vertical field of view, degrees; auto: 0, parallel projection",
                 .session_help = "3D: vertical field of view, degrees; 0: parallel projection",
                 .allows_auto = true,
                 .numbers = {.in_file = "degrees",
                             .typed = fmt::format("DEGREES from 0 (parallel) to {}, or 'auto'",
                                                  render::greatest_field_of_view),
                             .low = 0,
                             .high = render::greatest_field_of_view},
                 .set = set_fov,
                 .get = get_fov},
      DrawingKey{.name = "style",
                 .placeholder = "STYLE",
                 .help = "shape of particles: discs (2D), spheres (3D), "
                         "cells (a rectangle or box on the axes of each particle, deformed with it: "
                         "gaps are hairlines where the strain varies, and wider in layouts off a lattice), "
                         "or surface (continuous bodies with interpolated values)",
                 .session_help = "shape of particles: discs (2D), spheres (3D), cells, or surface",
                 .allows_auto = true,
                 .words = {"style", names_of_styles},
                 .set = set_style,
                 .get = get_style},
      DrawingKey{.name = "cut",
                 .placeholder = "EXPRESSION|none",
                 .help = "particles to hide, by their initial position, such as 'y < 0'",
                 .session_help = "particles to hide, by their initial position, such as y < 0",
                 .is_free_text = true,
                 .set = set_text<&Drawing::cut>,
                 .get = get_text<&Drawing::cut>},
      DrawingKey{.name = "hide",
                 .placeholder = "BODY,...|none",
                 .help = "bodies to hide",
                 .session_help = "bodies to hide",
                 .is_free_text = true,
                 .set = set_text<&Drawing::hide>,
                 .get = get_text<&Drawing::hide>},
      DrawingKey{
          .name = "outline",
          .placeholder = "OUTLINE",
          .help =
              "2D: lines around bodies: deformed, undeformed (their initial shape, a thin line), both or none",
          .session_help = "2D: lines around bodies: deformed, undeformed, both or none",
          .words = {"outline", names_of_outlines},
          .set = set_outline,
          .get = get_outline},
      DrawingKey{
          .name = "follow",
          .placeholder = "BODY|none",
          .help = "body whose centre of mass stays in the middle of the picture; the view is relative to it",
          .session_help = "body that stays in the middle of the picture",
          .is_free_text = true,
          .set = set_text<&Drawing::follow>,
          .get = get_text<&Drawing::follow>},
      DrawingKey{.name = "glyph",
                 .placeholder = "TIMES",
                 .help = "drawn diameter of discs and spheres, in true diameters of the particles",
                 .session_help = "drawn diameter of discs and spheres, in true diameters of the particles",
                 .numbers = {.in_file = "number",
                             .typed = fmt::format("a number from {} to {}", render::least_glyph,
                                                  render::greatest_glyph),
                             .low = render::least_glyph,
                             .high = render::greatest_glyph},
                 .set = set_glyph,
                 .get = get_glyph},
      DrawingKey{.name = "background",
                 .placeholder = "white|black|transparent|#RRGGBB",
                 .help = "background: white, black, #rrggbb, or transparent (PNG with opacity); "
                         "texts get a contrasting colour, dark on transparent",
                 .session_help = "background: white, black, #rrggbb or transparent",
                 .is_free_text = true,
                 .pattern = "^(white|black|transparent|#[0-9A-Fa-f]{6})$",
                 .numbers = {.typed = std::string(right_colors)},
                 .set = set_background,
                 .get = get_background},
      DrawingKey{
          .name = "text",
          .placeholder = "PART,...",
          .help = "texts to draw: all, none (the particles fill the whole picture), "
                  "or some of title, method, time, bar, scale, axes",
          .session_help = "texts to draw: all, none, or some of title, method, time, bar, scale, axes",
          .words = {.kind = "text", .names = names_of_texts, .is_list = true},
          .pattern = "^(all|none|(title|method|time|bar|scale|axes)(,(title|method|time|bar|scale|axes))*)$",
          .numbers = {.typed = "all, none, or some of title, method, time, bar, scale, axes"},
          .set = set_texts,
          .get = get_texts},
      DrawingKey{.name = "bar_position",
                 .placeholder = "POSITION",
                 .help = "position of the colour bar or legend: right, left or bottom",
                 .session_help = "position of the colour bar or legend: right, left or bottom",
                 .words = {"position", names_of_bar_positions},
                 .set = set_bar_position,
                 .get = get_bar_position},
      DrawingKey{
          .name = "bar_format",
          .placeholder = "FORMAT|auto",
          .help =
              "numbers of the colour bar: %.2f for two decimals, %.1e for powers of ten without SI prefix",
          .session_help = "numbers of the colour bar, such as %.2f or %.1e",
          .is_free_text = true,
          .pattern = R"(^(auto|%\.[0-9][fe])$)",
          .numbers = {.typed = std::string(right_formats)},
          .set = set_bar_format,
          .get = get_bar_format},
      DrawingKey{
          .name = "axes_position",
          .placeholder = "POSITION",
          .help = "3D: position of the axes: inside the picture, at the bottom right, or outside, below it",
          .session_help = "3D: position of the axes: inside or outside of the picture",
          .words = {"position", names_of_axes_positions},
          .set = set_axes_position,
          .get = get_axes_position},
      DrawingKey{.name = "title",
                 .placeholder = "TEXT|none|auto",
                 .help = "title of the picture; auto: the scene's title",
                 .session_help = "title of the picture; auto: the scene's title",
                 .allows_auto = true,
                 .is_free_text = true,
                 .pattern = R"(^[^\u0000-\u001f\u007f]{0,200}$)",
                 .numbers = {.typed = std::string(right_lines)},
                 .set = set_title,
                 .get = get_title},
      DrawingKey{
          .name = "font_size",
          .placeholder = "POINTS|auto",
          .help = "size of texts in points (pixels = POINTS / 72 × dpi), which also scales lines; "
                  "auto: from the picture size, or 7 points if --width is given",
          .allows_auto = true,
          .numbers = {.in_file = "points",
                      .typed = fmt::format("POINTS from {} to {}, or 'auto'", least_font, greatest_font),
                      .low = least_font,
                      .high = greatest_font},
          .set = set_font_size,
          .get = get_font_size},
      DrawingKey{.name = "size",
                 .placeholder = "WIDTHxHEIGHT",
                 .help = "size of a frame, pixels",
                 .numbers = {.count = 2,
                             .whole = true,
                             .between = 'x',
                             .in_file = "[width, height]",
                             .typed = fmt::format("WIDTHxHEIGHT such as 1280x720, each from {} to {} pixels",
                                                  render::least_size, render::greatest_size),
                             .low = render::least_size,
                             .high = render::greatest_size},
                 .set = set_size,
                 .get = get_size},
      DrawingKey{.name = "width",
                 .placeholder = "LENGTH|none",
                 .help = "width on paper, such as 85mm: "
                         "with --dpi it gives the width in pixels; keeps the proportions of --size",
                 .is_free_text = true,
                 .pattern = R"(^(none|[0-9]+(\.[0-9]+)?(mm|cm|in))$)",
                 .numbers = {.typed = fmt::format("none or {}", right_print_widths)},
                 .set = set_width,
                 .get = get_width},
      DrawingKey{.name = "dpi",
                 .placeholder = "N|auto",
                 .help = "pixels per inch, for --width and --font-size; auto: 96, or 300 if --width is given",
                 .allows_auto = true,
                 .numbers = {.in_file = "pixels per inch",
                             .typed = fmt::format("N from {} to {}, or 'auto'", least_dpi, greatest_dpi),
                             .low = least_dpi,
                             .high = greatest_dpi},
                 .set = set_dpi,
                 .get = get_dpi},
      DrawingKey{.name = "frames",
                 .placeholder = "N",
                 .help = "number of frames after the frame at t = 0, evenly spaced in time",
                 .counts_frames = true,
                 .numbers = {.whole = true, .in_file = "whole number", .low = 1, .high = most_frames},
                 .set = set_frames,
                 .get = get_frames},
  };
  return table;
}

std::optional<std::string> DrawingKey::Words::first_unknown(const std::string& text) const {
  const std::vector<std::string> known = names();
  if (has_formula(text)) return std::nullopt;
  for (const std::string& part : is_list ? split_at_commas(text) : std::vector{text})
    if (std::ranges::find(known, part) == known.end()) return part;
  return std::nullopt;
}

std::string DrawingKey::option() const {
  std::string text = "--" + std::string(name);
  std::ranges::replace(text, '_', '-');
  return text;
}

const DrawingKey& drawing_key(std::string_view name) {
  return *std::ranges::find(drawing_keys(), name, &DrawingKey::name);
}

void set_typed(Drawing& drawing, const DrawingKey& key, const std::string& text) {
  const std::optional<DrawingValue> value = typed_value(key, text);
  Drawing changed = drawing;
  if (!value || !key.set(changed, *value).empty())
    throw UsageError(fmt::format("{} is '{}'; it must be {}", key.option(), shown(text), key.numbers.typed));
  drawing = changed;
}

}  // namespace taut::cli
