#include "cli/drawing_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <CLI/CLI.hpp>

#include "cli/unknown_name.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The two numbers about `between`.
template <class Number>
std::optional<std::array<Number, 2>> pair_of(std::string_view text, char between) {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const auto first = number<Number>(text.substr(0, at));
  const auto second = number<Number>(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::array<Number, 2>{*first, *second};
}

std::optional<std::array<double, 2>> parse_range(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const auto range = pair_of<double>(text, ':');
  if (!range || !std::isfinite((*range)[0]) || !std::isfinite((*range)[1]) || (*range)[0] >= (*range)[1])
    throw UsageError("--range is '" + text + "', not LOW:HIGH with LOW less than HIGH (0:2e6), nor 'auto'");
  return range;
}

std::array<int, 2> parse_size(const std::string& text) {
  const auto fits = [](int side) { return side >= least_size && side <= greatest_size; };
  const auto size = pair_of<int>(text, 'x');
  if (!size || !fits((*size)[0]) || !fits((*size)[1]))
    throw UsageError("--size is '" + text + "', not WIDTHxHEIGHT (1280x720), each from " +
                     std::to_string(least_size) + " to " + std::to_string(greatest_size) + " pixels");
  return *size;
}

/// The first map of the table that suits the field.
const Colormap* default_colormap(const Field& field) {
  return &*std::ranges::find(colormaps(), field.is_signed, &Colormap::diverging);
}

template <class Table>
std::vector<std::string> keys(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.key);
  return names;
}

}  // namespace

void declare_drawing_options(CLI::App& app, DrawingOptions& options) {
  app.add_option("--color", options.color, "the field to colour by (`taut list fields`)")
      ->option_text("FIELD");
  app.add_option("--range", options.range,
                 "of the colours, in the field's unit; auto: over the whole sequence")
      ->option_text("LOW:HIGH|auto");
  app.add_option("--colormap", options.colormap, "`taut list colormaps`; default: by the field")
      ->option_text("NAME");
  app.add_option("--size", options.size, "of a frame, in pixels")->option_text("WIDTHxHEIGHT");
}

Drawing with_options(Drawing drawing, const DrawingOptions& options) {
  if (options.color && *options.color != drawing.color) {
    drawing.color = *options.color;
    drawing.range.reset();
    drawing.colormap.clear();
  }
  if (options.range) drawing.range = parse_range(*options.range);
  if (options.colormap) drawing.colormap = *options.colormap;
  if (options.size) drawing.size = parse_size(*options.size);
  return drawing;
}

DrawingPlan plan_drawing(const Drawing& drawing) {
  DrawingPlan plan{};
  plan.field = find_field(drawing.color);
  if (!plan.field) throw UsageError(unknown_name("field", drawing.color, keys(fields())));
  plan.colormap = drawing.colormap.empty() ? default_colormap(*plan.field) : find_colormap(drawing.colormap);
  if (!plan.colormap) throw UsageError(unknown_name("colour map", drawing.colormap, keys(colormaps())));
  plan.range = drawing.range;
  if (const auto& view = drawing.view) plan.view = View{(*view)[0], (*view)[1], (*view)[2], (*view)[3]};
  plan.width = drawing.size[0];
  plan.height = drawing.size[1];
  return plan;
}

}  // namespace taut
