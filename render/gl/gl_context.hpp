#pragma once

#include <memory>

#include "render/image/image.hpp"

namespace taut::render {

/// An OpenGL 3.3 core context without a window. The one place that knows which library provides it.
class GlContext {
 public:
  explicit GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// While it lives, the context is current in this thread and framebuffer 0 is `target`, which must be of
  /// the context's size. Row 0 of OpenGL is the bottom row of the image.
  class Current {
   public:
    Current(GlContext& context, Image& target);
    ~Current();  // the finished picture is in the image
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
  };

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  int width_, height_;
};

}  // namespace taut::render
