#pragma once

#include <cstdint>
#include <memory>

#include "render/image/image.hpp"

namespace taut::render {

/// OpenGL 3.3 core in software.
class GlContext {
 public:
  explicit GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context current in this thread. `target` has the context's size and receives the picture of
  /// `framebuffer()`. OpenGL's row 0 is the bottom row of the image.
  class Current {
   public:
    /// Throws UsageError without enough memory.
    Current(GlContext& context, Image& target);
    ~Current();  // completes the picture
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

    std::uint32_t framebuffer() const;

   private:
    [[maybe_unused]] GlContext& context_;
    [[maybe_unused]] Image& target_;
  };

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  int width_, height_;
};

}  // namespace taut::render
