#include "render/colormap.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace taut::render {
namespace {

// viridis, plasma, inferno, magma: van der Walt & Smith 2015 (CC0); cividis: Nuñez, Anderton & Renslow 2018
constexpr std::uint32_t viridis[] = {0x440154, 0x481668, 0x482878, 0x443a83, 0x3e4989, 0x375a8c, 0x31688e,
                                     0x2b758e, 0x26828e, 0x21908c, 0x1f9e89, 0x25ab82, 0x35b779, 0x4ec36b,
                                     0x6ece58, 0x90d741, 0xb5de2b, 0xdde31e, 0xfde725};
constexpr std::uint32_t plasma[] = {0x0d0887, 0x2b0793, 0x46039f, 0x5d00a6, 0x7201a8, 0x880aa5, 0x9c179e,
                                    0xad2693, 0xbd3786, 0xcb4779, 0xd8576b, 0xe3685f, 0xed7953, 0xf58b46,
                                    0xfb9f3a, 0xfeb32f, 0xfdca26, 0xfae31f, 0xf0f921};
constexpr std::uint32_t inferno[] = {0x000004, 0x09061f, 0x1b0c42, 0x330a5e, 0x4b0c6b, 0x62146e, 0x781c6d,
                                     0x8f2469, 0xa52c60, 0xbb3654, 0xcf4446, 0xe05536, 0xed6925, 0xf68013,
                                     0xfb9a06, 0xfcb519, 0xf7d03c, 0xf1ec6c, 0xfcffa4};
constexpr std::uint32_t magma[] = {0x000004, 0x08071e, 0x180f3e, 0x2c1160, 0x451077, 0x5c167f, 0x721f81,
                                   0x882781, 0x9f2f7f, 0xb6367a, 0xcd4071, 0xe24d66, 0xf1605d, 0xf9795d,
                                   0xfd9567, 0xfeaf78, 0xfec98d, 0xfde3a5, 0xfcfdbf};
constexpr std::uint32_t cividis[] = {0x00224e, 0x002c65, 0x123570, 0x2b406d, 0x3b496c, 0x4a536c, 0x575d6d,
                                     0x646770, 0x707173, 0x7c7b78, 0x8a8678, 0x979177, 0xa59c74, 0xb4a76f,
                                     0xc3b369, 0xd2bf60, 0xe1cc55, 0xf1d945, 0xfee838};
// Moreland 2009, "Diverging Color Maps for Scientific Visualization", darker in the middle to be visible on white
constexpr std::uint32_t coolwarm[] = {0x3b4cc0, 0x4d66d3, 0x5f7de2, 0x7192ea, 0x83a4ec, 0x95b1e9,
                                      0xa5badf, 0xb3bed1, 0xbebebe, 0xcfb9ae, 0xdbaf9b, 0xe1a287,
                                      0xe38f72, 0xe0785e, 0xd65e49, 0xc73d37, 0xb40426};
constexpr std::uint32_t rainbow[] = {0x0000ff, 0x00ffff, 0x00ff00, 0xffff00, 0xff0000};
// stops short of white, the default background
constexpr std::uint32_t gray[] = {0x101010, 0xe0e0e0};

// Okabe & Ito 2002, "Color Universal Design". Gray replaces black, which would be invisible on black.
constexpr std::uint32_t categories[] = {0x0072b2, 0xe69f00, 0x009e73, 0xd55e00,
                                        0x56b4e9, 0xcc79a7, 0xf0e442, 0x999999};
constexpr double darker = 0.6;  // in the second round

constexpr Colormap maps[] = {
    {"viridis", "perceptually uniform, blue to yellow", false, viridis},
    {"plasma", "perceptually uniform, blue over red to yellow", false, plasma},
    {"inferno", "perceptually uniform, black over red to light yellow", false, inferno},
    {"magma", "perceptually uniform, black over purple to light yellow", false, magma},
    {"cividis", "perceptually uniform, suited to colour-blind readers", false, cividis},
    {"coolwarm", "diverging, blue over gray to red, for signed fields", true, coolwarm},
    {"rainbow", "blue over green to red, as in the papers; not perceptually uniform", false, rainbow},
    {"gray", "dark to light gray, for print", false, gray},
};

double channel(std::uint32_t color, int shift) { return static_cast<double>((color >> shift) & 0xff); }

}  // namespace

Rgb Colormap::at(double t) const {
  const double last = static_cast<double>(stops.size() - 1);
  const double place = t > 0 ? std::min(t, 1.0) * last : 0.0;  // NaN gives 0
  const auto i = static_cast<std::size_t>(std::min(place, last - 1));
  const double f = place - static_cast<double>(i);
  const auto mix = [&](int shift) {
    const double value = (1 - f) * channel(stops[i], shift) + f * channel(stops[i + 1], shift);
    return static_cast<std::uint8_t>(std::lround(value));
  };
  return {mix(16), mix(8), mix(0)};
}

std::array<Rgb, 256> Colormap::table(double from, double to) const {
  std::array<Rgb, 256> colors;
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = at(from + (to - from) * (static_cast<double>(i) / 255.0));
  return colors;
}

Rgb category_color(std::size_t k) {
  const std::uint32_t color = categories[k % std::size(categories)];
  const double light = k / std::size(categories) % 2 == 0 ? 1 : darker;
  const auto part = [&](int shift) {
    return static_cast<std::uint8_t>(std::lround(light * channel(color, shift)));
  };
  return {part(16), part(8), part(0)};
}

std::span<const Colormap> colormaps() { return maps; }

const Colormap* find_colormap(std::string_view key) {
  const auto* found = std::ranges::find(maps, key, &Colormap::key);
  return found == std::end(maps) ? nullptr : found;
}

}  // namespace taut::render
