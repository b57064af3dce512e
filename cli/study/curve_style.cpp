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

using Rgb = std::array<double, 3>;  // 0 to 255

// viridis without colours that are hardly visible on white
constexpr std::array<Rgb, 5> ramp = {
    {{68, 1, 84}, {62, 74, 137}, {38, 130, 142}, {53, 183, 121}, {144, 215, 65}}};
constexpr std::array ramp_dashes = {1, 2, 4};
constexpr std::size_t most_solid = 8;  // without dashes

std::string mixed(const Rgb& a, const Rgb& b, double share_of_b) {
  std::string color = "#";
  for (std::size_t c = 0; c < 3; ++c)
    color += fmt::format("{:02X}", std::lround(std::lerp(a[c], b[c], share_of_b)));
  return color;
}

std::string ramp_color(double t) {
  const double place = t * (ramp.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  return mixed(ramp[k], ramp[k + 1], place - static_cast<double>(k));
}

/// From dark (0) to light (1), with the same brightness for all colours.
std::string shade(const std::string& color, double t) {
  constexpr double darkest = 0.2, lightest = 0.72;  // brightness still visible on white
  Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::stoi(color.substr(1 + 2 * c, 2), nullptr, 16);
  const double own = (0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]) / 255;  // luma of ITU-R BT.601
  const double wanted = std::lerp(darkest, lightest, t);
  return wanted < own ? mixed({0, 0, 0}, rgb, wanted / own)
                      : mixed(rgb, {255, 255, 255}, (wanted - own) / (1 - own));
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

std::vector<CurveStyle> line_styles(const std::vector<std::string>& names, bool has_columns) {
  std::vector<CurveStyle> all = curve_styles(names);
  const std::size_t methods = std::set(names.begin(), names.end()).size();
  if (names.size() < 2 || (methods == names.size() && !has_columns)) return all;
  std::map<std::string, std::size_t> lines, placed;  // by colour, which several methods may share
  for (const CurveStyle& style : all) ++lines[style.color];
  std::map<std::string, int> dash_of;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string color = all[k].color;
    const std::size_t place = placed[color]++;
    all[k].dash = dash_of.try_emplace(names[k], methods > 1 ? all[k].dash : 1).first->second;
    if (lines[color] > most_solid) all[k].dash = ramp_dashes[place % ramp_dashes.size()];
    if (lines[color] == 1) continue;
    const double t = static_cast<double>(place) / static_cast<double>(lines[color] - 1);
    all[k].color = methods > 1 ? shade(color, t) : ramp_color(t);
  }
  return all;
}

}  // namespace taut::cli
