#include "cli/study/line_styles.hpp"

#include <array>

namespace taut::cli {
namespace {

// Okabe and Ito's colours, which colour-blind readers tell apart too, with darker ones for their yellow and
// black
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                               "#56B4E9", "#E69F00", "#6A3D9A", "#444444"};
// with eight colours no two of 56 lines look alike
constexpr std::array markers = {7, 5, 9, 13, 11, 15, 4};  // of gnuplot: filled disc, square, ...
constexpr std::array dashes = {1, 2, 4};                  // solid, dashed, dotted and dashed

}  // namespace

std::string line_style(std::size_t k) {
  const int dash = dashes[k / colors.size() % dashes.size()];
  return std::string("linecolor '") + colors[k % colors.size()] + "' dashtype " + std::to_string(dash);
}

std::string marker_style(std::size_t k) {
  return "pointtype " + std::to_string(markers[k % markers.size()]) + " pointsize 1.4";
}

}  // namespace taut::cli
