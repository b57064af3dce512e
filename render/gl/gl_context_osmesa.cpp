#include <cstdlib>
#include <mutex>
#include <stdexcept>

#include "render/gl/gl_context.hpp"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <GL/osmesa.h>

#include "render/gl/memory.hpp"

namespace taut::render {

struct GlContext::Handle {
  OSMesaContext context = nullptr;
  ~Handle() {
    if (context) OSMesaDestroyContext(context);
  }
};

GlContext::GlContext(int width, int height)
    : handle_(std::make_unique<Handle>()), width_(width), height_(height) {
  check_memory(width, height);
  // threads share the environment
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  // a cache would write to the home folder
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_BGRA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  handle_->context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!handle_->context) throw std::runtime_error("OSMesa cannot create an OpenGL 3.3 core context");
}

GlContext::~GlContext() = default;

GlContext::Current::Current(GlContext& context, Image& target) : context_(context), target_(target) {
  check_memory(target.width, target.height);
  if (target.width != context.width_ || target.height != context.height_) {
    throw std::logic_error("the image and its OpenGL context differ in size");
  }
  if (!OSMesaMakeCurrent(context.handle_->context, target.pixels.data(), GL_UNSIGNED_BYTE, target.width,
                         target.height)) {
    fail_for_memory(target.width, target.height);
  }
  OSMesaPixelStore(OSMESA_Y_UP, 0);  // top row first
}

GlContext::Current::~Current() {
  glFinish();
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}

std::uint32_t GlContext::Current::framebuffer() const { return 0; }

}  // namespace taut::render
