#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/gnuplot.hpp"

namespace taut::cli {

/// Lengths are pixels at 96 dpi with texts of 11 points; `scale` enlarges everything.
struct PlotLook {
  std::optional<std::string> title{};  // default: title of the results; empty: none
  int width = plot_width;
  std::optional<int> height{};  // default: depends on the panels
  double scale = 1;
  bool log_x = false, log_y = false;
};

/// With `width`, a length on paper, the defaults are texts of 7 points and 300 dpi.
struct PlotLookOptions {
  std::optional<std::string> title, log, size, width;
  std::optional<double> dpi, font_size;
};

/// Throws UsageError.
PlotLook plot_look(const PlotLookOptions& typed, const PlotFiles& files);

struct PanelPlot {
  struct Panel {
    std::string label;
    double low = 0, high = 1;        // of positive values on a logarithmic axis
    std::vector<std::string> lines;  // elements of gnuplot's `plot` command
  };
  struct Entry {
    std::string name, style;
    bool operator==(const Entry&) const = default;
  };
  std::string title, x_label;
  double x_low = 0, x_high = 1;  // as in Panel
  std::vector<Panel> panels;
  std::vector<Entry> legend;
  std::string note{};
  bool is_tall = false;      // a single panel is high
  bool has_markers = false;  // kept away from the frame
};

std::string panel_script(const PanelPlot& plot, const PlotFiles& files, const PlotLook& look);

/// `label`: "deflection, mm".
struct AxisScale {
  double factor = 1;
  std::string label;
};
/// Chooses an SI prefix or a power of ten.
AxisScale axis_scale(const std::string& name, const std::string& unit, double greatest, bool is_log);
/// Ticks at 1, 2 and 5 of each decade, in long ranges at powers of ten.
std::string log_ticks(double low, double high, std::string (*show)(double));
/// Approximate, in pixels.
double width_of_ticks(double low, double high);

}  // namespace taut::cli
