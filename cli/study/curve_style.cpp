#include "cli/study/curve_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

// Okabe and Ito's colours for colour-blind readers, with violet and grey instead of yellow and black
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                               "#56B4E9", "#E69F00", "#6A3D9A", "#444444"};
// disc, square, triangle, diamond, inverted triangle, pentagon
constexpr std::array markers = {7, 5, 9, 13, 11, 15};  // filled; one less: open
constexpr std::size_t same_marker = std::lcm(colors.size(), markers.size());
constexpr std::array dashes = {1, 2, 4, 3, 5};

// viridis without colours that are hardly visible on white
constexpr std::array<std::array<double, 3>, 5> ramp = {
    {{68, 1, 84}, {62, 74, 137}, {38, 130, 142}, {53, 183, 121}, {144, 215, 65}}};
constexpr std::array ramp_dashes = {1, 2, 4};
constexpr std::size_t most_solid = 8;  // without dashes

std::string ramp_color(double t) {
  const double place = t * (ramp.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  std::string color = "#";
  for (std::size_t c = 0; c < 3; ++c)
    color += fmt::format("{:02X}",
                         std::lround(std::lerp(ramp[k][c], ramp[k + 1][c], place - static_cast<double>(k))));
  return color;
}

/// Index in the catalogue; beyond its end if unknown.
std::size_t number_of(const std::string& method) {
  const auto all = methods();
  const auto found = std::ranges::find(all, method, &MethodInfo::name);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  return all.size() + hash_of(method) % (colors.size() * markers.size());
}

}  // namespace

std::size_t most_marked_lines() { return colors.size() * markers.size(); }

std::string CurveStyle::line() const { return fmt::format("linecolor '{}' dashtype {}", color, dash); }

std::string CurveStyle::marker() const { return fmt::format("pointtype {} linecolor '{}'", filled, color); }

std::vector<CurveStyle> curve_styles(const std::vector<std::string>& names) {
  std::vector<CurveStyle> all(names.size());
  std::map<std::string, std::size_t> uses;
  std::map<std::string, std::set<int>> with_dashes;
  for (const bool first : {true, false}) {
    for (std::size_t line = 0; line < names.size(); ++line) {
      const std::size_t k = number_of(names[line]);
      if (first ? uses.contains(names[line]) : !all[line].color.empty()) continue;
      const std::size_t use = uses[names[line]]++;
      CurveStyle& style = all[line];
      style.color = colors[k % colors.size()];
      std::set<int>& taken = with_dashes[style.color];
      std::size_t dash = k / colors.size() + use;
      for (std::size_t tried = 0;
           use > 0 && tried < dashes.size() && taken.contains(dashes[dash % dashes.size()]); ++tried)
        ++dash;
      style.dash = dashes[dash % dashes.size()];
      taken.insert(style.dash);
      style.filled = markers[(k + k / same_marker + use) % markers.size()];
      style.open = style.filled - 1;
    }
  }
  return all;
}

CurveStyle numbered_style(std::size_t k) {
  const int filled = markers[k % markers.size()];
  return {colors[k % colors.size()], dashes[k / colors.size() % dashes.size()], filled, filled - 1};
}

std::vector<CurveStyle> line_styles(const std::vector<std::string>& names) {
  std::vector<CurveStyle> all = curve_styles(names);
  std::set<std::string> lines;
  for (const CurveStyle& style : all) lines.insert(style.line());
  const bool of_one = std::ranges::count(names, names.front()) == std::ssize(names);
  if (names.size() < 2 || (lines.size() == names.size() && !of_one)) return all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].color = ramp_color(static_cast<double>(k) / static_cast<double>(all.size() - 1));
    all[k].dash = all.size() > most_solid ? ramp_dashes[k % ramp_dashes.size()] : 1;
  }
  return all;
}

}  // namespace taut::cli
