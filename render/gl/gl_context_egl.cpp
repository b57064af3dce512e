#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "render/gl/gl_context.hpp"
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "render/gl/memory.hpp"

namespace taut::render {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("EGL " + what + " (error " + std::to_string(eglGetError()) + ")");
}

/// Mesa's display without a screen [EGL_MESA_platform_surfaceless, EGL_KHR_surfaceless_context]. Shared by all
/// threads, never closed.
EGLDisplay open_display() {
  // equal bytes on all machines
  setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  // a cache would write to the home folder
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  const EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY)
    fail("has no surfaceless display; install Mesa: apt-get install libegl-mesa0");
  if (!eglInitialize(display, nullptr, nullptr)) fail("cannot open its surfaceless display");
  return display;
}

EGLDisplay display() {
  static const EGLDisplay one = open_display();
  return one;
}

}  // namespace

struct GlContext::Handle {
  EGLContext context = EGL_NO_CONTEXT;
  GLuint framebuffer = 0, color = 0;
  ~Handle() {
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display(), context);
  }
};

GlContext::GlContext(int width, int height)
    : handle_(std::make_unique<Handle>()), width_(width), height_(height) {
  check_memory(width, height);
  const EGLDisplay on = display();
  eglBindAPI(EGL_OPENGL_API);  // per thread
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(on, wanted, &config, 1, &count) || count == 0) fail("has no configuration for OpenGL");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  handle_->context = eglCreateContext(on, config, EGL_NO_CONTEXT, attributes);
  if (handle_->context == EGL_NO_CONTEXT) fail("cannot create an OpenGL 3.3 core context");
}

GlContext::~GlContext() = default;

GlContext::Current::Current(GlContext& context, Image& target) : context_(context), target_(target) {
  if (target.width != context.width_ || target.height != context.height_) {
    throw std::logic_error("the image and its OpenGL context differ in size");
  }
  check_memory(target.width, target.height);
  Handle& handle = *context.handle_;
  eglBindAPI(EGL_OPENGL_API);
  if (!eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, handle.context))
    fail("cannot activate a context");
  if (handle.framebuffer != 0) return;
  glGenFramebuffers(1, &handle.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, handle.framebuffer);
  glGenRenderbuffers(1, &handle.color);
  glBindRenderbuffer(GL_RENDERBUFFER, handle.color);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, target.width, target.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, handle.color);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  fail_for_memory(target.width, target.height);
}

std::uint32_t GlContext::Current::framebuffer() const { return context_.handle_->framebuffer; }

GlContext::Current::~Current() {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, target_.width, target_.height, GL_BGRA, GL_UNSIGNED_BYTE, target_.pixels.data());
  const auto row = [&](int number) {
    return target_.pixels.begin() + static_cast<std::ptrdiff_t>(target_.offset(0, number));
  };
  for (int top = 0, bottom = target_.height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(row(top), row(top + 1), row(bottom));
  eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace taut::render
