#include "cli/drawing/drawing.hpp"

#include <cmath>

#include "cli/text/print_size.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {

std::vector<double> ColorFormula::values(std::span<const std::vector<double>> of_fields, int dim,
                                         std::span<const double> x, std::span<const double> x0,
                                         double time) const {
  const auto d = static_cast<std::size_t>(dim);
  const std::size_t n = fields.size();
  std::vector<double> arguments(n + places.size()), all(x.size() / d);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) arguments[k] = of_fields[k][i];
    for (std::size_t k = 0; k < d; ++k) {
      arguments[n + k] = x[d * i + k];
      arguments[n + 3 + k] = x0[d * i + k];
    }
    all[i] = function(arguments, time);
  }
  return all;
}

std::optional<double> pixels_on_paper(const Drawing& drawing) {
  const auto width = parsed_print_width(drawing.print_width);
  if (!width) return std::nullopt;
  return *width / mm_per_inch * drawing.dpi.value_or(print_dpi);
}

Drawing sized(Drawing drawing) {
  const auto width = pixels_on_paper(drawing);
  auto& size = drawing.look.size;
  if (width && size) {
    const double height = *width * size->height / size->width;
    size = {static_cast<int>(std::lround(*width)), static_cast<int>(std::lround(height))};
  }
  if (width || drawing.font_points)
    drawing.look.texts.font = drawing.font_points.value_or(print_font) / points_per_inch *
                              drawing.dpi.value_or(width ? print_dpi : screen_dpi);
  return drawing;
}

ColorMeaning meaning(const Drawing& drawing) {
  const Field& field = *drawing.field;
  const render::Colormap* map = drawing.look.colormap;
  if (!drawing.formula.empty())
    return {drawing.formula, "", map && map->diverging ? std::optional(0.0) : std::nullopt};
  return {field.name, field.unit, field.is_signed ? std::optional(field.middle) : std::nullopt};
}

std::vector<double> color_values(const Drawing& drawing, const Snapshot& now) {
  if (drawing.formula.empty()) return evaluate(*drawing.field, now);
  const ColorFormula& formula = drawing.of_formula;
  return formula.values(evaluate(formula.fields, now), now.dim, now.x, now.x0, now.time);
}

std::vector<std::string> names_of_fields() { return names_of_fields(3); }

std::vector<std::string> names_of_fields(int dim) {
  std::vector<std::string> names;
  for (const Field& field : fields(dim)) names.emplace_back(field.key);
  return names;
}

const Field& known_field(const std::string& key, int dim) {
  if (const Field* field = find_field(key, dim)) return *field;
  throw UsageError(unknown_name("field", key, names_of_fields(dim)));
}

}  // namespace taut::cli
