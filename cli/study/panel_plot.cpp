#include "cli/study/panel_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/print_size.hpp"
#include "engine/error.hpp"
#include "render/page/ticks.hpp"

namespace taut::cli {
namespace {

constexpr int least_side = 64, greatest_side = 8192;

double within(const char* option, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return value;
  throw UsageError(
      fmt::format("--{} is {}; it must be from {} to {}{}", option, brief(value), low, high, unit));
}

std::pair<int, int> typed_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto width = parsed<int>(text.substr(0, cross));
  const auto height = cross == std::string::npos ? std::nullopt : parsed<int>(text.substr(cross + 1));
  const auto fits = [](std::optional<int> side) {
    return side && *side >= least_side && *side <= greatest_side;
  };
  if (fits(width) && fits(height)) return {*width, *height};
  throw UsageError(
      fmt::format("--size is '{}'; it must be WIDTHxHEIGHT such as 1280x720, each from {} to {} pixels", text,
                  least_side, greatest_side));
}

// pixels
constexpr int of_title = 45, without_title = 10, below = 30;
constexpr int inside_top = 8, inside_foot = 34;
constexpr int name_height = 22;
constexpr int least_beside = 900;  // legend above the panels in narrower pictures

struct Layout {
  int width = 0, above = 0, panel = 0;
  double total = 0, left = 0, right = 1;  // `left`, `right`: shares of the width
  bool beside = false;
  int legend_columns = 1, legend_height = 0;
};

std::vector<std::string> names_of(const PanelPlot& plot) {
  std::vector<std::string> names;
  for (const PanelPlot::Entry& entry : plot.legend) names.push_back(entry.name);
  return names;
}

double left_margin(const PanelPlot& plot, double least) {
  constexpr double label = 44;
  double widest = 0;
  for (const PanelPlot::Panel& panel : plot.panels)
    widest = std::max(widest, width_of_ticks(panel.low, panel.high));
  return std::max(label + widest, least);
}

Layout layout_of(const PanelPlot& plot, const PlotLook& look, const std::string& title) {
  constexpr int greatest_height = 300, least_height = 140, most_together = 2400, of_single = 460;
  constexpr double of_width = 0.66;
  const auto panels = static_cast<int>(plot.panels.size()), entries = static_cast<int>(plot.legend.size());
  const std::vector<std::string> names = names_of(plot);
  Layout layout{.width = look.width};
  layout.beside = look.width >= least_beside && entries > 0;
  layout.left = left_margin(plot, look.width >= least_beside ? 109 : 70) / look.width;
  layout.right =
      layout.beside ? 1 - (1 - right_margin(names)) * plot_width / look.width : 1 - 20.0 / look.width;
  if (entries > 0 && !layout.beside) {
    layout.legend_columns = std::clamp(static_cast<int>((look.width - 20) / legend_width(names)), 1, entries);
    layout.legend_height = name_height * ((entries - 1) / layout.legend_columns + 1);
  }
  layout.above = (title.empty() ? without_title : of_title) + layout.legend_height;
  const int of_names = layout.beside ? name_height * (entries + 1) : 0;
  const int greatest = plot.is_tall && panels == 1 ? of_single : greatest_height;
  layout.panel = std::max(std::clamp(most_together / panels, least_height, greatest), of_names / panels);
  if (!layout.beside) layout.panel = std::min(layout.panel, static_cast<int>(of_width * look.width));
  if (look.height) layout.panel = std::max((*look.height - layout.above - below) / panels, least_height / 2);
  layout.total = look.height ? std::max(*look.height, layout.above + below + panels * layout.panel)
                             : layout.above + layout.panel * panels + below;
  return layout;
}

/// Has an empty plot for each column.
std::string legend_of(const PanelPlot& plot, const Layout& layout) {
  const auto columns = static_cast<std::size_t>(layout.beside ? 1 : layout.legend_columns);
  const double from = layout.beside ? layout.right * layout.width + 10 : 10,
               wide = (layout.width - 20.0) / static_cast<double>(columns),
               top = layout.beside ? layout.above : layout.above - layout.legend_height - 2;
  std::string text = "set margins 0, 0, 0, 0\nunset border\nunset tics\n";
  for (std::size_t column = 0; column < columns; ++column) {
    std::vector<std::string> entries{"NaN notitle"};
    for (std::size_t k = column; k < plot.legend.size(); k += columns)
      entries.push_back(
          fmt::format("keyentry {} title {}", plot.legend[k].style, plot_text(plot.legend[k].name)));
    text += fmt::format(
        "set key at screen {:.4g}, screen {:.4g} left top Left reverse samplen {} spacing 1.25 maxrows {}\n"
        "plot [0:1] [0:1] {}\n",
        (from + wide * static_cast<double>(column)) / layout.width, 1 - top / layout.total,
        layout.beside ? 4 : 3, plot.legend.size(), join(entries, ", \\\n     "));
  }
  return text + "unset key\nset tics\n";
}

/// Adds a margin; the ends differ by a factor of at least 3.
std::pair<double, double> log_range(double low, double high) {
  const double margin = std::max(1.15, std::sqrt(3 / (high / low)));
  return {low / margin, high * margin};
}

std::string log_axis(char axis, double low, double high) {
  const auto [begin, end] = log_range(low, high);
  return fmt::format("set {0}range [{1}:{2}]\nset {0}tics {3}\n", axis, exact(begin), exact(end),
                     log_ticks(begin, end, six_digits));
}

}  // namespace

PlotLook plot_look(const PlotLookOptions& typed, const PlotFiles& files) {
  PlotLook look;
  if (typed.title) look.title = *typed.title == "none" ? "" : *typed.title;
  if (typed.log) {
    constexpr std::array allowed{"x", "y", "xy"};
    if (std::ranges::find(allowed, *typed.log) == allowed.end())
      throw UsageError(fmt::format("--log is '{}'; it must be x, y or xy", *typed.log));
    look.log_x = typed.log->find('x') != std::string::npos;
    look.log_y = typed.log->find('y') != std::string::npos;
  }
  const bool printed = typed.width.has_value(), pixels = files.picture.extension() == ".png";
  const double font =
      within("font-size", typed.font_size.value_or(printed ? print_font : axis_font), 1, 100, " points");
  double dpi = within("dpi", typed.dpi.value_or(printed ? print_dpi : screen_dpi), 30, 2400, "");
  if (!pixels) dpi = screen_dpi;  // SVG and PDF sizes are lengths
  look.scale = font / axis_font * dpi / screen_dpi;
  double width = plot_width;
  std::optional<double> height;
  if (typed.size) std::tie(width, height) = typed_size(*typed.size);
  if (printed) {
    const auto mm = parsed_print_width(*typed.width);
    if (!mm)
      throw UsageError(fmt::format("--width is '{}'; it must be {}", *typed.width, right_print_widths));
    const double wide = *mm / mm_per_inch * dpi;
    if (height) height = *height * wide / width;
    width = wide;
  }
  if (width > greatest_side || height.value_or(0) > greatest_side)
    throw UsageError(fmt::format(
        "the picture would be {:.0f} pixels {}; at most {} are allowed; use a smaller --width or --dpi",
        std::max(width, height.value_or(0)), width < height.value_or(0) ? "high" : "wide", greatest_side));
  look.width = static_cast<int>(std::lround(width / look.scale));
  if (height) look.height = static_cast<int>(std::lround(*height / look.scale));
  return look;
}

std::string panel_script(const PanelPlot& plot, const PlotFiles& files, const PlotLook& look) {
  const std::string title = look.title.value_or(plot.title);
  const Layout layout = layout_of(plot, look, title);
  const double total = layout.total;
  std::string text = plot_head(files, layout.width, static_cast<int>(total), look.scale);
  if (!plot.note.empty()) text += plot_note(plot.note, 8 / total);
  text += fmt::format("set multiplot{}\n", title.empty() ? "" : " title " + titled(title, layout.width));
  text += plot.legend.empty() ? "unset key\n" : legend_of(plot, layout);
  text += fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset border 3 back linecolor '#444444'\n"
      "set grid back linetype 1 linecolor '#e4e4e4'\nset tics nomirror\nset autoscale xfix\n",
      exact(layout.left), exact(layout.right));
  if (look.log_x || look.log_y)
    text += fmt::format("set logscale {}{}\n", look.log_x ? "x" : "", look.log_y ? "y" : "");
  if (plot.has_markers)
    text += fmt::format("set offsets {0}, {0}, {1}, {1}\n", look.log_x ? "0" : "graph 0.03",
                        look.log_y ? "0" : "graph 0.04");
  if (look.log_x) text += log_axis('x', plot.x_low, plot.x_high);
  for (std::size_t k = 0; k < plot.panels.size(); ++k) {
    const PanelPlot::Panel& panel = plot.panels[k];
    const double top = layout.above + layout.panel * static_cast<double>(k);
    text += fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n",
                        1 - (top + inside_top) / total, 1 - (top + layout.panel - inside_foot) / total);
    if (k + 1 == plot.panels.size()) text += fmt::format("set xlabel {}\n", plot_text(plot.x_label));
    if (look.log_y) text += log_axis('y', panel.low, panel.high);
    text +=
        fmt::format("set ylabel {} font ',{}'\nplot {}\nunset label\n", plot_text(panel.label),
                    font_that_fits(panel.label, 0.8 * layout.panel, 11), join(panel.lines, ", \\\n     "));
  }
  return text + "unset multiplot\n";
}

AxisScale axis_scale(const std::string& name, const std::string& unit, double greatest, bool is_log) {
  if (unit.empty() && is_log) return {1, name};
  const render::Scale scale = render::scale_for(greatest, unit);
  const bool both = !name.empty() && !scale.unit.empty();
  return {scale.factor, fmt::format("{}{}{}", name, both ? ", " : "", scale.unit)};
}

std::string log_ticks(double low, double high, std::string (*show)(double)) {
  const double decades = std::log10(high) - std::log10(low);
  const bool many = decades > 3.5;
  const int step = static_cast<int>(decades / 10) + 1;
  const int last = static_cast<int>(std::floor(std::log10(high)));
  std::vector<std::string> all;
  for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= last; ++decade)
    for (const double digit : {1, 2, 5}) {
      const double tick = digit * std::pow(10, decade);
      if (tick < low || tick > high || (many && digit > 1) || decade % step != 0) continue;
      all.push_back(fmt::format("{} {}", plot_text(show(tick)), brief(tick)));
    }
  return fmt::format("({})", join(all));
}

double width_of_ticks(double low, double high) {
  if (!(high > low)) return text_width(fmt::format("{:g}", low), axis_font);
  const double power = std::pow(10, std::floor(std::log10(high - low)) - 1);
  const double step = (high - low > 50 * power ? 5 : 2) * power;  // at most gnuplot's step
  std::vector<std::string> numbers;
  for (const double end : {low, high})
    for (const double way : {-2, -1, 0, 1, 2})
      numbers.push_back(fmt::format("{:g}", step * (std::round(end / step) + way)));
  return text_width(numbers, axis_font);
}

}  // namespace taut::cli
