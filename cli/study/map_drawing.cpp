#include "cli/study/map_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "cli/study/curve_style.hpp"
#include "cli/study/panel_plot.hpp"
#include "cli/text/format.hpp"
#include "engine/judge/verdict.hpp"
#include "render/colormap.hpp"

namespace taut::cli {
namespace {

struct Kind {
  std::string name, color;
};

/// Colours darken with severity.
std::vector<Kind> kinds() {
  constexpr std::array colors = {"#d6ecf7", "#f3cc63", "#b49bd8", "#d9712f", "#8c2236"};
  const std::vector<std::string> names = names_of_verdicts();
  std::vector<Kind> all;
  for (std::size_t k = 0; k < names.size(); ++k)
    all.push_back({names[k], colors[k * (colors.size() - 1) / (names.size() - 1)]});
  all.push_back({"no result", "#dddddd"});
  return all;
}

std::size_t kind_of(const MapCell& cell, const std::vector<Kind>& all) {
  const auto found = std::ranges::find(all, cell.verdict, &Kind::name);
  return static_cast<std::size_t>(found == all.end() ? all.end() - all.begin() - 1 : found - all.begin());
}

struct TimeUnit {
  double scale;
  const char* name;
};

TimeUnit time_unit(const StabilityMap& map) {
  double latest = 0;
  for (const auto& row : map.cells)
    for (const auto& cell : row)
      if (cell && cell->since) latest = std::max(latest, *cell->since);
  return latest < 0.1 ? TimeUnit{1e3, "ms"} : TimeUnit{1, "s"};
}

template <class Use>
void each_cell(const StabilityMap& map, const Use& use) {
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t v = 0; v < map.values.size(); ++v)
      if (map.cells[r][v]) use(r, v, *map.cells[r][v]);
}

/// Kinds that occur; gnuplot does not count empty blocks.
std::vector<std::size_t> kinds_in(const StabilityMap& map, const std::vector<Kind>& all) {
  std::vector<bool> there(all.size());
  each_cell(map, [&](std::size_t, std::size_t, const MapCell& cell) { there[kind_of(cell, all)] = true; });
  std::vector<std::size_t> found;
  for (std::size_t kind = 0; kind < all.size(); ++kind)
    if (there[kind]) found.push_back(kind);
  return found;
}

std::string shown(const MapCell& cell, const TimeUnit& unit) {
  if (cell.since) return fmt::format("{:.3g}", *cell.since * unit.scale);
  return cell.verdict.empty() ? cell.status : "";
}

/// Layout in pixels.
struct Page {
  double left = 0, right = 0;
  double cell = 0;
  int tick_step = 1;     // cells per label
  int font = 0;          // points; 0: no text
  int most_letters = 0;  // per cell
};

/// `texts` of the cells determine the font.
Page page_of(const StabilityMap& map, const std::vector<std::string>& texts) {
  constexpr double of_key = 178, of_marker = 46, most_left = 0.45 * plot_width, most_font = 10, gap = 6;
  Page page;
  std::vector<std::string> rows;
  for (const std::string& row : map.rows) rows.push_back(shortened(row));
  page.left = std::min(text_width(rows, axis_font) + of_marker, most_left);
  page.right = plot_width - of_key;
  page.cell = (page.right - page.left) / static_cast<double>(map.values.size());
  page.tick_step = static_cast<int>(std::ceil((text_width(map.values, axis_font) + gap) / page.cell));
  for (int size = most_font; size >= smallest_font && page.font == 0; --size)
    if (text_width(texts, size) + gap <= page.cell) page.font = size;
  if (page.font > 0) page.most_letters = static_cast<int>((page.cell - gap) / text_width("0", page.font));
  return page;
}

std::string row_markers(const StabilityMap& map) {
  std::vector<std::string> methods;
  for (const std::string& row : map.rows) methods.push_back(row.substr(0, row.find(',')));
  const std::vector<CurveStyle> styles = curve_styles(methods);
  std::string text;
  for (std::size_t r = 0; r < styles.size(); ++r)
    text += fmt::format("set label '' at graph -0.012, first {} point {}{}\n", r + 1, styles[r].marker(),
                        point_size("1.2"));
  return text;
}

std::string ticks(const std::vector<std::string>& names, std::size_t step = 1) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < names.size(); k += step)
    all.push_back(fmt::format("{} {}", plot_text(shortened(names[k])), k + 1));
  return fmt::format("({})", join(all));
}

std::string verdict_data(const StabilityMap& map) {
  const TimeUnit unit = time_unit(map);
  const std::vector<Kind> all = kinds();
  std::string text = plot_comment(map.title);
  for (const std::size_t kind : kinds_in(map, all)) {
    text += plot_comment(all[kind].name) +
            plot_comment(fmt::format("column; row; since, s; {}; method; shown", map.label));
    each_cell(map, [&](std::size_t r, std::size_t v, const MapCell& cell) {
      if (kind_of(cell, all) != kind) return;
      text += fmt::format("{} {} {} {} {} {}\n", v + 1, r + 1, cell.since ? exact(*cell.since) : "NaN",
                          data_text(map.values[v]), data_text(map.rows[r]), data_text(shown(cell, unit)));
    });
    text += "\n\n";
  }
  return text;
}

constexpr int around = 190, row_height = 36;

std::string frame(const StabilityMap& map, const PlotFiles& files, const Page& page) {
  const int rows = static_cast<int>(map.rows.size()), columns = static_cast<int>(map.values.size());
  std::string text = plot_head(files, plot_width, around + row_height * rows) + plot_title(map.title);
  text += fmt::format("set border 0\nset tics scale 0\nset yrange [{}.5:0.5]\nset xrange [0.5:{}.5]\n", rows,
                      columns);
  text += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", page.left / plot_width,
                      page.right / plot_width);
  text += fmt::format("set xtics {}\nset ytics offset -1.6,0 {}\n{}",
                      ticks(map.values, static_cast<std::size_t>(page.tick_step)), ticks(map.rows),
                      row_markers(map));
  return text + fmt::format("set xlabel {}\nset bmargin 5.5\n", plot_text(map.label));
}

constexpr const char* box = "1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5)";

std::string verdict_script(const StabilityMap& map, const PlotFiles& files) {
  std::vector<std::string> numbers;
  each_cell(map, [&](std::size_t, std::size_t, const MapCell& cell) {
    if (cell.since) numbers.push_back(shown(cell, time_unit(map)));
  });
  const Page page = page_of(map, numbers);
  const std::vector<Kind> all = kinds();
  std::vector<std::string> plots;
  for (int index = 0; const std::size_t kind : kinds_in(map, all)) {
    const std::string block = fmt::format("data index {} using", index++);
    plots.push_back(fmt::format(
        "{} {} with boxxyerror fillstyle solid 1 border linecolor '#ffffff' fillcolor '{}' title {}", block,
        box, all[kind].color, plot_text(all[kind].name)));
    if (page.font == 0) continue;
    plots.push_back(fmt::format(
        "{} 1:2:(strlen(strcol(6)) > {} ? '' : strcol(6)) with labels font ',{}' textcolor '{}' notitle",
        block, page.most_letters, page.font, kind + 2 == all.size() ? "#ffffff" : "#222222"));
  }
  const std::string remark = page.font > 0
                                 ? std::string("numbers: start of the verdict, ") + time_unit(map).name
                                 : "the start of each verdict is in " + files.data().filename().string();
  return fmt::format("{}set key outside right top Left reverse spacing 1.4\n{}plot {}\n",
                     frame(map, files, page), plot_note(fmt::format("Scene {}; {}", map.scene, remark), 0.03),
                     join(plots, ", \\\n     "));
}

struct MapValues {
  double low = INFINITY, high = -INFINITY;
  AxisScale scale{};
  bool any_unstable = false, any_without = false;

  explicit MapValues(const StabilityMap& map) {
    each_cell(map, [&](std::size_t, std::size_t, const MapCell& cell) {
      any_without |= !cell.value;
      if (!cell.value) return;
      low = std::min(low, *cell.value), high = std::max(high, *cell.value);
      any_unstable |= cell.verdict != "stable";
    });
    const std::string& unit = map.measure->unit;
    std::string name = map.measure->name;
    std::ranges::replace(name, '_', ' ');
    scale = unit == "%" ? AxisScale{1, name + ", %"}
                        : axis_scale(name, unit, std::max(std::abs(low), std::abs(high)), /*is_log=*/false);
  }
  std::string shown(const MapCell& cell) const {
    if (!cell.value) return cell.verdict.empty() ? cell.status : cell.verdict;
    return fmt::format("{:.3g}{}", *cell.value * scale.factor, cell.verdict == "stable" ? "" : " ×");
  }
};

std::string measure_data(const StabilityMap& map) {
  const MapValues values(map);
  std::string text = plot_comment(map.title);
  for (const bool with_value : {true, false}) {
    if (!with_value && !values.any_without) continue;
    text += plot_comment(fmt::format("column; row; {}; {}; method; shown", values.scale.label, map.label));
    each_cell(map, [&](std::size_t r, std::size_t v, const MapCell& cell) {
      if (cell.value.has_value() != with_value) return;
      text += fmt::format("{} {} {} {} {} {}\n", v + 1, r + 1,
                          cell.value ? exact(*cell.value * values.scale.factor) : "NaN",
                          data_text(map.values[v]), data_text(map.rows[r]), data_text(values.shown(cell)));
    });
    text += "\n\n";
  }
  return text;
}

std::string measure_script(const StabilityMap& map, const PlotFiles& files) {
  const MapValues values(map);
  std::vector<std::string> texts, stops;
  each_cell(map, [&](std::size_t, std::size_t, const MapCell& cell) {
    if (cell.value) texts.push_back(values.shown(cell));
  });
  const Page page = page_of(map, texts);
  for (const std::uint32_t stop : render::find_colormap("viridis")->stops)
    stops.push_back(fmt::format("{} '#{:06x}'", stops.size(), stop));
  double low = values.low * values.scale.factor, high = values.high * values.scale.factor;
  if (!(low < high)) high = low + std::max(1e-3 * std::abs(low), 1e-12), low -= high - low;
  const double height = around + row_height * static_cast<double>(map.rows.size());
  std::string text =
      fmt::format("{}unset key\nset palette defined ({})\n", frame(map, files, page), join(stops));
  text += fmt::format(
      "set cbrange [{}:{}]\nset cblabel {}\nset colorbox user origin screen {}, screen {} size screen {}, "
      "screen {}\n",
      exact(low), exact(high), plot_text(values.scale.label), (page.right + 24) / plot_width, 110 / height,
      20.0 / plot_width, std::max(0.2, 1 - 180 / height));
  std::vector<std::string> plots{fmt::format(
      "data index 0 using {}:3 with boxxyerror fillstyle solid 1 border linecolor '#ffffff' fillcolor palette",
      box)};
  const auto labels = [&](int index, const std::string& condition, const char* color) {
    if (page.font > 0)
      plots.push_back(
          fmt::format("data index {} using 1:2:({} && strlen(strcol(6)) <= {} ? "
                      "strcol(6) : '') with labels font ',{}' textcolor '{}'",
                      index, condition, page.most_letters + 1, page.font, color));
  };
  const std::string middle = exact(low + 0.55 * (high - low));
  labels(0, "$3 < " + middle, "#ffffff");
  labels(0, "$3 >= " + middle, "#222222");
  if (values.any_without) {
    plots.push_back(fmt::format(
        "data index 1 using {} with boxxyerror fillstyle solid 1 border linecolor '#ffffff' fillcolor '#e8e8e8'",
        box));
    labels(1, "1", "#555555");
  }
  const std::string remark =
      fmt::format("Scene {}{}{}", map.scene, values.any_unstable ? "; ×: not stable" : "",
                  values.any_without ? "; gray: no value" : "");
  return fmt::format("{}{}plot {}\n", text, plot_note(remark, 0.03), join(plots, ", \\\n     "));
}

}  // namespace

std::string map_script(const StabilityMap& map, const PlotFiles& files) {
  return map.measure ? measure_script(map, files) : verdict_script(map, files);
}

std::string map_data(const StabilityMap& map) { return map.measure ? measure_data(map) : verdict_data(map); }

}  // namespace taut::cli
