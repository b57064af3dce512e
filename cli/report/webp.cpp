#include "cli/report/webp.hpp"

#include <webp/encode.h>

#include "engine/error.hpp"

namespace taut::cli {

std::string webp(const render::Image& image) {
  constexpr float quality = 80;  // lower values blur the colour bar's numbers
  std::uint8_t* bytes = nullptr;
  const std::size_t size =
      WebPEncodeBGRA(image.pixels.data(), image.width, image.height, 4 * image.width, quality, &bytes);
  if (size == 0)
    throw UsageError("a picture of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                     " pixels does not fit into WebP; draw smaller frames or leave out --embed");
  std::string file(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return file;
}

}  // namespace taut::cli
