#pragma once

#include <cstdint>
#include <memory>

#include "render/image/image.hpp"

namespace taut::render {

/// An OpenGL 3.3 core context without a window, in software. Which library provides it is chosen when taut is
/// built (TAUT_GL): gl_context_TAUT_GL.cpp knows, and nothing else.
class GlContext {
 public:
  explicit GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// While it lives, the context is current in this thread, and what is drawn into `framebuffer()` is drawn
  /// into `target`, which must be of the context's size. Row 0 of OpenGL is the bottom row of the image.
  class Current {
   public:
    /// Throws UsageError where there is no memory for such a picture.
    Current(GlContext& context, Image& target);
    ~Current();  // the finished picture is in the image
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
