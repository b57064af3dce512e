#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// Size and texts of a plot. Layouts count pixels at 96 dpi with texts of 11 points; `scale` enlarges all of it.
struct PlotLook {
  std::optional<std::string> title{};  // default: of the results; empty: none
  int width = plot_width;              // before scaling
  std::optional<int> height{};         // default: by the number of panels
  double scale = 1;
  bool log_x = false, log_y = false;
};

/// Options of a plot as typed. A `width` on paper has texts of 7 points at 300 dpi by default.
struct PlotLookOptions {
  std::optional<std::string> title, log, size, width;
  std::optional<double> dpi, font_size;
};

/// Throws UsageError for wrong values.
PlotLook plot_look(const PlotLookOptions& typed, const PlotFiles& files);

/// Panels above each other, with a common x axis and one legend.
struct PanelPlot {
  struct Panel {
    std::string label;               // of the y axis
    double low = 0, high = 1;        // of the positive values, if the axis is logarithmic
    std::vector<std::string> lines;  // elements of gnuplot's `plot`, without titles
  };
  struct Entry {
    std::string name, style;  // such as "with lines linecolor '#0072B2'"
    bool operator==(const Entry&) const = default;
  };
  std::string title, x_label;
  double x_low = 0, x_high = 1;  // of the positive values, if the axis is logarithmic
  std::vector<Panel> panels;
  std::vector<Entry> legend;
  std::string note{};        // at the foot
  bool is_tall = false;      // one panel is higher than those of histories
  bool has_markers = false;  // keeps markers away from the frame
};

/// Gnuplot script. The legend is right of the panels, in a narrow picture above them.
std::string panel_script(const PanelPlot& plot, const PlotFiles& files, const PlotLook& look);

/// A quantity on an axis: numbers times `factor`, labelled "deflection, mm".
struct AxisScale {
  double factor = 1;
  std::string label;
};
/// Chooses the SI prefix as in frames. On a logarithmic axis, a number without a unit takes no power of ten.
AxisScale axis_scale(const std::string& name, const std::string& unit, double greatest, bool is_log);
/// Ticks of a logarithmic axis for a script: 1, 2, 5 of each decade, in long ranges powers of ten.
std::string log_ticks(double low, double high, std::string (*show)(double));
/// Approximate width of the numbers from `low` to `high` at an axis, pixels.
double width_of_ticks(double low, double high);

}  // namespace taut::cli
