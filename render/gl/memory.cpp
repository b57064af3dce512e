#include "render/gl/memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "engine/error.hpp"

namespace taut::render {

void fail_for_memory(int width, int height) {
  throw UsageError(fmt::format(
      "there is no memory for a picture of {}x{}; use a smaller --size or fewer --threads", width, height));
}

void check_memory(int width, int height) {
  // bytes: 4 for each pixel of the picture and of its copy, 8 for each of 4 samples per pixel
  constexpr std::size_t samples = std::size_t{128} << 20, beside = std::size_t{32} << 20;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t bytes = 8 * pixels + std::min(32 * pixels, samples) + beside;
  const std::unique_ptr<void, void (*)(void*)> trial(std::malloc(bytes), std::free);
  if (!trial) fail_for_memory(width, height);
}

}  // namespace taut::render
