#include "cli/study/curve_style.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "cli/text/format.hpp"
#include "engine/families/catalogue.hpp"

namespace taut::cli {
namespace {

// Okabe and Ito's colours, which colour-blind readers tell apart too, with darker ones for their yellow and
// black
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                               "#56B4E9", "#E69F00", "#6A3D9A", "#444444"};
// disc, square, triangle, diamond, triangle on its head, pentagon; with eight colours no two of 24 methods
// look alike
constexpr std::array markers = {7, 5, 9, 13, 11, 15};  // filled; one less is open
constexpr std::array dashes = {1, 2, 4, 3, 5};

/// Its place in the list of methods; of one that is not there, such as of another version, any.
std::size_t number_of(const std::string& method) {
  const auto all = methods();
  const auto found = std::ranges::find(all, method, &MethodInfo::name);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  return all.size() + hash_of(method) % (colors.size() * markers.size());
}

}  // namespace

std::string CurveStyle::line() const { return "linecolor '" + color + "' dashtype " + std::to_string(dash); }

std::string CurveStyle::marker() const {
  return "pointtype " + std::to_string(filled) + " linecolor '" + color + "'";
}

std::vector<CurveStyle> curve_styles(const std::vector<std::string>& names) {
  std::vector<CurveStyle> all;
  std::map<std::string, std::size_t> of_method, of_color;  // how many there are already
  for (const std::string& method : names) {
    const std::size_t k = number_of(method);
    CurveStyle style{.color = colors[k % colors.size()]};
    style.dash = dashes[of_color[style.color]++ % dashes.size()];
    style.filled = markers[(k + of_method[method]++) % markers.size()];
    style.open = style.filled - 1;
    all.push_back(style);
  }
  return all;
}

}  // namespace taut::cli
