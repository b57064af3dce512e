#pragma once

#include <cstdint>
#include <memory>

#include "render/image/image.hpp"

namespace taut::render {

/// OpenGL 3.3 core context in software. The build option TAUT_GL selects its source file.
class GlContext {
 public:
  explicit GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context current in this thread as long as the object exists. `target` receives the picture drawn into
  /// `framebuffer()`; it must have the context's size. OpenGL's row 0 is the bottom row of the image.
  class Current {
   public:
    /// Throws UsageError if there is not enough memory for the picture.
    Current(GlContext& context, Image& target);
    ~Current();  // completes the picture in the image
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
