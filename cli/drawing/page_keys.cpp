#include "cli/drawing/page_keys.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/print_size.hpp"
#include "cli/text/shown.hpp"

namespace taut::cli {
namespace {

struct NamedColor {
  std::string_view name;
  render::Rgb color;
};
constexpr std::array<NamedColor, 2> named_colors{{{"white", {255, 255, 255}}, {"black", {0, 0, 0}}}};

constexpr std::string_view transparent = "transparent";
constexpr std::string_view all_texts = "all";

struct NamedText {
  std::string_view name;
  bool render::TextParts::*part;
};
using Parts = render::TextParts;
constexpr std::array<NamedText, 6> named_texts{{{"title", &Parts::title},
                                                {"method", &Parts::method},
                                                {"time", &Parts::time},
                                                {"bar", &Parts::bar},
                                                {"scale", &Parts::scale},
                                                {"axes", &Parts::axes}}};

// in enumerator order
constexpr std::array<std::string_view, 3> bar_positions{"right", "left", "bottom"};
constexpr std::array<std::string_view, 2> axes_positions{"inside", "outside"};

template <std::optional<double> Drawing::*Member>
std::string set_optional(Drawing& drawing, const DrawingValue& value, std::string_view key, double low,
                         double high) {
  (drawing.*Member).reset();
  if (is_word(value)) return "";
  const double number = numbers(value)[0];
  if (!(number >= low && number <= high))
    return number_out_of_bounds(key, number, fmt::format("from {} to {}", low, high));
  drawing.*Member = number;
  return "";
}

template <std::optional<double> Drawing::*Member>
DrawingValue get_optional(const Drawing& drawing) {
  return drawing.*Member ? DrawingValue(Numbers{*(drawing.*Member)}) : left_open();
}

}  // namespace

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream words(text);
  for (std::string part; std::getline(words, part, ',');) parts.push_back(part);
  return parts;
}

std::string line_of_text(const std::string& text) {
  constexpr std::size_t longest = 200;
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
  // JSON replaces whatever TOML refuses, including surrogates, which is_utf8 accepts
  const bool is_line = text.size() <= longest && std::ranges::none_of(text, is_control) &&
                       parse_json(Json(text).dump(), "text").text() == text;
  return is_line ? "" : fmt::format("'{}' must be {}", shown(text), right_lines);
}

std::string number_out_of_bounds(std::string_view key, double value, std::string_view bounds) {
  return fmt::format("{} = {} must be {}", key, exact(value), bounds);
}

bool is_whole_within(double value, int low, int high) {
  return value == std::floor(value) && value >= low && value <= high;
}

std::string set_size(Drawing& drawing, const DrawingValue& value) {
  using render::greatest_size, render::least_size;
  const Numbers& sides = numbers(value);
  for (const double side : sides)
    if (!is_whole_within(side, least_size, greatest_size))
      return fmt::format("size must be two whole numbers of pixels from {} to {}", least_size, greatest_size);
  drawing.look.size = {static_cast<int>(sides[0]), static_cast<int>(sides[1])};
  return "";
}

DrawingValue get_size(const Drawing& drawing) {
  const render::Size size = drawing.look.size.value();
  return Numbers{static_cast<double>(size.width), static_cast<double>(size.height)};
}

std::string set_background(Drawing& drawing, const DrawingValue& value) {
  const std::string& text = word(value);
  drawing.look.transparent = text == transparent;
  if (drawing.look.transparent) return drawing.look.background = render::white, "";
  const auto* named = std::ranges::find(named_colors, text, &NamedColor::name);
  if (named != named_colors.end()) return drawing.look.background = named->color, "";
  unsigned code = 0;
  const char* const end = text.data() + text.size();
  if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, code, 16).ptr != end)
    return fmt::format("background = \"{}\" must be {}", text, right_colors);
  const auto part = [code](unsigned shift) { return static_cast<std::uint8_t>(code >> shift & 255); };
  drawing.look.background = {part(16), part(8), part(0)};
  return "";
}

DrawingValue get_background(const Drawing& drawing) {
  if (drawing.look.transparent) return std::string(transparent);
  const auto& [red, green, blue] = drawing.look.background;
  const auto* named = std::ranges::find(named_colors, drawing.look.background, &NamedColor::color);
  if (named != named_colors.end()) return std::string(named->name);
  return fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
}

std::vector<std::string> names_of_texts() {
  std::vector<std::string> names{std::string(all_texts), std::string(nothing)};
  for (const NamedText& text : named_texts) names.emplace_back(text.name);
  return names;
}

std::string set_texts(Drawing& drawing, const DrawingValue& value) {
  const std::vector<std::string> given = split_at_commas(word(value));
  const auto has = [&](std::string_view name) { return std::ranges::find(given, name) != given.end(); };
  if (given.size() != 1 && (given.empty() || has(nothing) || has(all_texts)))
    return "text must be all, none, or a list such as time,bar,scale";
  drawing.look.bare = has(nothing);
  for (const NamedText& text : named_texts)
    drawing.look.texts.parts.*text.part = has(text.name) || has(all_texts) || has(nothing);
  return "";
}

DrawingValue get_texts(const Drawing& drawing) {
  const Parts& parts = drawing.look.texts.parts;
  if (drawing.look.bare || parts == Parts{}) return std::string(drawing.look.bare ? nothing : all_texts);
  std::vector<std::string> names;
  for (const NamedText& text : named_texts)
    if (parts.*text.part) names.emplace_back(text.name);
  return join(names, ",");
}

std::vector<std::string> names_of_bar_positions() { return {bar_positions.begin(), bar_positions.end()}; }

std::string set_bar_position(Drawing& drawing, const DrawingValue& value) {
  const auto place = std::ranges::find(bar_positions, word(value));
  drawing.look.texts.bar = static_cast<render::BarPosition>(place - bar_positions.begin());
  return "";
}

DrawingValue get_bar_position(const Drawing& drawing) {
  return std::string(bar_positions[static_cast<std::size_t>(drawing.look.texts.bar)]);
}

std::string set_bar_format(Drawing& drawing, const DrawingValue& value) {
  const std::string& text = word(value);
  drawing.look.bar_format = {};
  if (text == automatic) return "";
  if (text.size() != 4 || !text.starts_with("%.") || text[2] < '0' || text[2] > '9' ||
      (text[3] != 'f' && text[3] != 'e'))
    return fmt::format("bar_format = \"{}\" must be {}", text, right_formats);
  drawing.look.bar_format = {text[2] - '0', text[3] == 'e'};
  return "";
}

DrawingValue get_bar_format(const Drawing& drawing) {
  const render::NumberFormat& format = drawing.look.bar_format;
  return format.decimals ? fmt::format("%.{}{}", *format.decimals, format.scientific ? 'e' : 'f')
                         : left_open();
}

std::vector<std::string> names_of_axes_positions() { return {axes_positions.begin(), axes_positions.end()}; }

std::string set_axes_position(Drawing& drawing, const DrawingValue& value) {
  drawing.look.texts.axes_outside = word(value) == axes_positions[1];
  return "";
}

DrawingValue get_axes_position(const Drawing& drawing) {
  return std::string(axes_positions[drawing.look.texts.axes_outside ? 1 : 0]);
}

std::string set_title(Drawing& drawing, const DrawingValue& value) {
  if (const std::string wrong = line_of_text(word(value)); !wrong.empty()) return "title: " + wrong;
  drawing.title.reset();
  if (word(value) != automatic) drawing.title = word(value) == nothing ? "" : word(value);
  return "";
}

DrawingValue get_title(const Drawing& drawing) {
  if (!drawing.title) return left_open();
  return drawing.title->empty() ? std::string(nothing) : *drawing.title;
}

std::string set_font_size(Drawing& drawing, const DrawingValue& value) {
  return set_optional<&Drawing::font_points>(drawing, value, "font_size", least_font, greatest_font);
}

std::string set_dpi(Drawing& drawing, const DrawingValue& value) {
  return set_optional<&Drawing::dpi>(drawing, value, "dpi", least_dpi, greatest_dpi);
}

std::string set_width(Drawing& drawing, const DrawingValue& value) {
  const std::string& text = word(value);
  if (text != nothing && !parsed_print_width(text))
    return fmt::format("width = \"{}\" must be none or {}", text, right_print_widths);
  drawing.print_width = text == nothing ? "" : text;
  return "";
}

DrawingValue get_font_size(const Drawing& drawing) { return get_optional<&Drawing::font_points>(drawing); }

DrawingValue get_dpi(const Drawing& drawing) { return get_optional<&Drawing::dpi>(drawing); }

DrawingValue get_width(const Drawing& drawing) {
  return drawing.print_width.empty() ? std::string(nothing) : drawing.print_width;
}

}  // namespace taut::cli
