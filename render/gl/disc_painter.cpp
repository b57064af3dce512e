#include "render/gl/disc_painter.hpp"

#include <algorithm>
#include <cstddef>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "render/gl/program.hpp"

namespace taut::render {
namespace {

// Each pixel is the mean of 2 × 2 samples.
constexpr int samples = 2;

// Bounds the buffers of a band to 16 Mi samples of 8 bytes; a picture of 1920 × 1080 is one band.
constexpr int samples_per_band = 1 << 24;

// `band` holds the plot's width, and the top and the height of the band, in pixels.
constexpr const char* vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 disc;   // x, y, radius in pixels
layout(location = 1) in vec4 color;
uniform vec3 band;
flat out vec4 disc_color;
flat out float radius;               // in samples, as is all that follows
out vec2 from_centre;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  radius = disc.z * 2.0;
  from_centre = corner * (radius + 1.0);
  vec2 place = disc.xy + from_centre / 2.0;
  gl_Position = vec4(2.0 * place.x / band.x - 1.0, 1.0 - 2.0 * (place.y - band.y) / band.z, 0.0, 1.0);
  disc_color = color;
})";

constexpr const char* fragment_shader = R"(#version 330 core
flat in vec4 disc_color;
flat in float radius;
in vec2 from_centre;
out vec4 color;
void main() {
  float r = length(from_centre);
  float coverage = radius + 0.5 - r;
  if (coverage <= 0.0) discard;
  color = vec4(disc_color.rgb, min(coverage, 1.0));
  // Nearest centre first; a rim that covers a sample in part never hides a disc that covers it whole.
  gl_FragDepth = 0.5 * (r / (radius + 1.0)) + (coverage < 1.0 ? 0.5 : 0.0);
})";

/// A colour and a depth buffer of the given size, in samples.
GLuint make_framebuffer(int width, int height) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  GLuint buffers[2] = {};
  glGenRenderbuffers(2, buffers);
  const GLenum formats[] = {GL_RGBA8, GL_DEPTH_COMPONENT32F};
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
  for (int i = 0; i < 2; ++i) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
    glRenderbufferStorage(GL_RENDERBUFFER, formats[i], width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, buffers[i]);
  }
  check_framebuffer(width, height);
  return framebuffer;
}

}  // namespace

DiscPainter::DiscPainter(int image_width, int image_height, const Rect& plot)
    : image_width_(image_width),
      image_height_(image_height),
      plot_(plot),
      band_height_(std::clamp(samples_per_band / (samples * samples * plot.width), 1, plot.height)) {
  framebuffer_ = make_framebuffer(samples * plot_.width, samples * band_height_);
  program_ = make_program(vertex_shader, fragment_shader);
  band_uniform_ = glGetUniformLocation(program_, "band");
  glGenVertexArrays(1, &vertices_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  const auto place = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Dot), place(offsetof(Dot, x)));
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Dot), place(offsetof(Dot, color)));
  for (const GLuint attribute : {0u, 1u}) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribDivisor(attribute, 1);  // one per disc; the four corners come from gl_VertexID
  }
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthFunc(GL_LESS);
  glClearColor(1, 1, 1, 1);
}

void DiscPainter::draw(std::span<const Dot> discs) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glClear(GL_COLOR_BUFFER_BIT);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  fill_buffer(discs.data(), discs.size_bytes(), capacity_);
  for (int top = 0; top < plot_.height; top += band_height_) {
    draw_band(top, std::min(band_height_, plot_.height - top), static_cast<int>(discs.size()));
  }
}

void DiscPainter::draw_band(int top, int height, int count) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, samples * plot_.width, samples * height);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (count > 0) {
    glEnable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glUseProgram(program_);
    glUniform3f(band_uniform_, static_cast<float>(plot_.width), static_cast<float>(top),
                static_cast<float>(height));
    glBindVertexArray(vertices_);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  }
  // The linear filter takes the mean of 2 × 2 samples, since each pixel centre lies amid four of them.
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  const int bottom = image_height_ - (plot_.y + top + height);
  glBlitFramebuffer(0, 0, samples * plot_.width, samples * height, plot_.x, bottom, plot_.x + plot_.width,
                    bottom + height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace taut::render
