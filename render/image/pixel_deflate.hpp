#pragma once

#include <cstdint>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// The rows of a picture as a PNG file holds them (R, G, B, no filter), compressed: a zlib stream [RFC 1950, 1951].
///
/// It looks for what pictures of particles are made of, pixel by pixel: the colour of the pixel to the left or
/// above goes on, or the colour was seen a short while ago. That takes a fifth of the time of zlib's search for
/// any string of bytes, and the files are as small.
std::vector<std::uint8_t> deflate_pixels(const Image& image);

}  // namespace taut::render
