#include "cli/drawing/look.hpp"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view automatic = "auto";

/// Exactly `Count` numbers with `between` between them.
template <class Number, std::size_t Count>
std::optional<std::array<Number, Count>> numbers(std::string_view text, char between) {
  std::array<Number, Count> values{};
  for (std::size_t k = 0; k < Count; ++k) {
    const std::size_t end = k + 1 < Count ? text.find(between) : text.size();
    const auto value = end == std::string_view::npos ? std::nullopt : parsed<Number>(text.substr(0, end));
    if (!value) return std::nullopt;
    values[k] = *value;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return values;
}

std::optional<std::array<double, 2>> parse_range(const std::string& text) {
  if (text == automatic) return std::nullopt;
  const auto range = numbers<double, 2>(text, ':');
  if (!range || !std::isfinite((*range)[0]) || !std::isfinite((*range)[1]) || (*range)[0] >= (*range)[1])
    throw UsageError("--range is '" + text + "', not LOW:HIGH with LOW less than HIGH (0:2e6), nor 'auto'");
  return range;
}

std::optional<std::array<double, 4>> parse_view(const std::string& text) {
  if (text == automatic) return std::nullopt;
  const auto view = numbers<double, 4>(text, ':');
  const bool good = view && std::ranges::all_of(*view, [](double end) { return std::isfinite(end); }) &&
                    (*view)[0] < (*view)[1] && (*view)[2] < (*view)[3];
  if (!good)
    throw UsageError("--view is '" + text +
                     "', not X_MIN:X_MAX:Y_MIN:Y_MAX in metres (-0.1:0.1:0:0.05), nor 'auto'");
  return view;
}

std::array<int, 2> parse_size(const std::string& text) {
  const auto fits = [](int side) { return side >= render::least_size && side <= render::greatest_size; };
  const auto size = numbers<int, 2>(text, 'x');
  if (!size || !fits((*size)[0]) || !fits((*size)[1]))
    throw UsageError("--size is '" + text + "', not WIDTHxHEIGHT (1280x720), each from " +
                     std::to_string(render::least_size) + " to " + std::to_string(render::greatest_size) +
                     " pixels");
  return *size;
}

/// The first map of the table that suits the field.
const render::Colormap* default_colormap(const Field& field) {
  return &*std::ranges::find(render::colormaps(), field.is_signed, &render::Colormap::diverging);
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
  app.add_option("--colormap", options.colormap, "`taut list render::colormaps`; default: by the field")
      ->option_text("COLORMAP");
  app.add_option("--view", options.view, "what is seen, m; auto: the whole motion")
      ->option_text("X0:X1:Y0:Y1|auto");
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
  if (options.view) drawing.view = parse_view(*options.view);
  if (options.size) drawing.size = parse_size(*options.size);
  return drawing;
}

const Field& known_field(const std::string& key) {
  if (const Field* field = find_field(key)) return *field;
  throw UsageError(unknown_name("field", key, keys(fields())));
}

DrawingPlan plan_drawing(const Drawing& drawing) {
  DrawingPlan plan{};
  plan.field = &known_field(drawing.color);
  plan.colormap =
      drawing.colormap.empty() ? default_colormap(*plan.field) : render::find_colormap(drawing.colormap);
  if (!plan.colormap)
    throw UsageError(unknown_name("colour map", drawing.colormap, keys(render::colormaps())));
  plan.range = drawing.range;
  if (const auto& view = drawing.view)
    plan.view = render::View{(*view)[0], (*view)[1], (*view)[2], (*view)[3]};
  plan.width = drawing.size[0];
  plan.height = drawing.size[1];
  return plan;
}

}  // namespace taut::cli
