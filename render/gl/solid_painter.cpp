#include "render/gl/solid_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "render/gl/memory.hpp"
#include "render/gl/program.hpp"

namespace taut::render {
namespace {

// per direction
constexpr int samples = 2;

constexpr int samples_per_band = 1 << 24;  // 8 bytes each

// x to the right, y downwards, z towards the camera
constexpr std::array<float, 3> to_light = {-0.32f, -0.44f, 0.839f};
constexpr float ambient = 0.72f;  // light on surfaces that face away
#define TAUT_LIGHT                                                  \
  "float light_on(vec3 normal, float ambient) {\n"                  \
  "  const vec3 to_light = vec3(-0.32, -0.44, 0.839);\n"            \
  "  float light = max(dot(normal, to_light), 0.0) / to_light.z;\n" \
  "  return min(ambient + (1.0 - ambient) * light, 1.0);\n"         \
  "}\n"

// `band`: width of the plot, top and height of the band, pixels; `depth`: greatest z, 1 / range
constexpr const char* ball_vertex_shader = R"(#version 330 core
layout(location = 0) in vec4 ball;   // x, y, z, radius in pixels
layout(location = 1) in vec4 color;
uniform vec3 band;
uniform vec2 depth;
flat out vec4 ball_color;
flat out vec2 ball_depth;            // of the centre; the radius in the same unit
out vec2 from_centre;                // in radii
void main() {
  // one triangle about the circle: less to set up than two
  const vec2 corners[3] = vec2[](vec2(0.0, 2.0), vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0));
  from_centre = corners[gl_VertexID % 3];
  vec2 place = ball.xy + from_centre * ball.w;
  ball_depth = vec2((depth.x - ball.z) * depth.y, ball.w * depth.y);
  gl_Position = vec4(2.0 * place.x / band.x - 1.0, 1.0 - 2.0 * (place.y - band.y) / band.z, 0.0, 1.0);
  ball_color = color;
})";

constexpr const char* ball_fragment_shader = "#version 330 core\n" TAUT_LIGHT R"(
flat in vec4 ball_color;
flat in vec2 ball_depth;
in vec2 from_centre;
out vec4 color;
void main() {
  float r2 = dot(from_centre, from_centre);
  if (r2 > 1.0) discard;
  vec3 normal = vec3(from_centre, sqrt(1.0 - r2));
  color = vec4(ball_color.rgb * light_on(normal, 0.72), 1.0);
  gl_FragDepth = ball_depth.x - ball_depth.y * normal.z;
})";

constexpr const char* triangle_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 color;
uniform vec3 band;
uniform vec2 depth;
flat out vec4 triangle_color;
void main() {
  gl_Position = vec4(2.0 * place.x / band.x - 1.0, 1.0 - 2.0 * (place.y - band.y) / band.z,
                     2.0 * (depth.x - place.z) * depth.y - 1.0, 1.0);
  triangle_color = color;
})";

constexpr const char* triangle_fragment_shader = R"(#version 330 core
flat in vec4 triangle_color;
out vec4 color;
void main() { color = vec4(triangle_color.rgb, 1.0); })";

constexpr const char* surface_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec2 shade;  // place among the colours, light
uniform vec3 band;
uniform vec2 depth;
out vec2 surface_shade;
void main() {
  gl_Position = vec4(2.0 * place.x / band.x - 1.0, 1.0 - 2.0 * (place.y - band.y) / band.z,
                     2.0 * (depth.x - place.z) * depth.y - 1.0, 1.0);
  surface_shade = shade;
})";

constexpr const char* surface_fragment_shader = R"(#version 330 core
in vec2 surface_shade;
uniform sampler2D palette;  // the last colour is for NaN
out vec4 color;
void main() {
  int last = textureSize(palette, 0).x - 2;
  int index = surface_shade.x < -1000.0 ? last + 1
                                        : int(floor(clamp(surface_shade.x, 0.0, 1.0) * float(last) + 0.5));
  color = vec4(texelFetch(palette, ivec2(index, 0), 0).rgb * surface_shade.y, 1.0);
})";

constexpr const char* resolve_vertex_shader = R"(#version 330 core
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); })";

// Compares the depths of opposite points with the pixel's: the mean shows hollows, the difference the slope. Points of
// very different depth belong to other objects.
constexpr const char* resolve_fragment_shader = "#version 330 core\n" TAUT_LIGHT R"(
uniform sampler2D colors, depths;
uniform ivec2 corner;    // bottom left of the band, pixels
uniform ivec2 top_edge;  // last column and row of samples
uniform float range;     // of depths, pixels
uniform float reach;     // radius of the shading, pixels
uniform vec3 background;
uniform float opacity;   // of the background
out vec4 color;

float depth_at(vec2 place) {
  float depth = texelFetch(depths, clamp(ivec2(2.0 * place), ivec2(0), top_edge), 0).r;
  return depth < 1.0 ? range * depth : 1e6;  // nothing is there
}

void main() {
  vec2 place = gl_FragCoord.xy - vec2(corner);
  vec4 mean = texture(colors, 2.0 * place / vec2(textureSize(colors, 0)));
  vec3 blank = (1.0 - mean.a) * background;
  ivec2 sample = 2 * ivec2(place);
  // the nearest of the four samples: a rim belongs to the object in front
  float z = range * min(min(texelFetch(depths, sample, 0).r, texelFetch(depths, sample + ivec2(1, 0), 0).r),
                        min(texelFetch(depths, sample + ivec2(0, 1), 0).r,
                            texelFetch(depths, sample + ivec2(1, 1), 0).r));
  vec2 slope = vec2(0.0);
  float hollow = 0.0;
  const vec2 directions[4] = vec2[](vec2(1.0, 0.0), vec2(0.7071, 0.7071), vec2(0.0, 1.0), vec2(-0.7071, 0.7071));
  const vec2 between[4] = vec2[](vec2(0.9239, 0.3827), vec2(0.3827, 0.9239), vec2(-0.3827, 0.9239),
                                 vec2(-0.9239, 0.3827));
  for (int i = 0; i < 8; ++i) {
    float far = i < 4 ? reach / 3.0 : reach;
    vec2 way = i < 4 ? directions[i] : between[i - 4];
    float a = (z - depth_at(place + far * way)) / far;
    float b = (z - depth_at(place - far * way)) / far;
    float weight_a = clamp(2.0 - abs(a), 0.0, 1.0), weight_b = clamp(2.0 - abs(b), 0.0, 1.0);
    slope += 0.25 * (weight_a * a - weight_b * b) / max(weight_a + weight_b, 0.1) * way;
    // occluders far in front of a pixel shade it less
    float shadow_a = clamp(a, -1.0, mix(0.5, 1.0, weight_a));
    float shadow_b = clamp(b, -1.0, mix(0.5, 1.0, weight_b));
    hollow += 0.125 * max(shadow_a + shadow_b, 0.0);
  }
  float light = light_on(normalize(vec3(-slope.x, slope.y, 1.0)), 0.6) * (1.0 - 0.6 * min(1.2 * hollow, 1.0));
  color = vec4((mean.rgb - blank) * light + blank, max(mean.a, opacity));
})";

GLuint make_texture(GLint format, GLenum kind, GLenum type, GLint filter, int width, int height,
                    const void* texels = nullptr) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, kind, type, texels);
  for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, which, filter);
  for (const GLenum which : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, which, GL_CLAMP_TO_EDGE);
  return texture;
}

/// Declares `floats` numbers, then `shades` numbers or, if `shades` is 0, a colour.
void declare_attributes(int floats, int shades, std::size_t stride) {
  const auto place = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  const auto bytes = static_cast<GLsizei>(stride);
  glVertexAttribPointer(0, floats, GL_FLOAT, GL_FALSE, bytes, place(0));
  const void* const rest = place(static_cast<std::size_t>(floats) * 4);
  if (shades > 0)
    glVertexAttribPointer(1, shades, GL_FLOAT, GL_FALSE, bytes, rest);
  else
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, bytes, rest);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
}

}  // namespace

float light_on(float x, float y, float z) {
  const float light = std::max(x * to_light[0] + y * to_light[1] + z * to_light[2], 0.0f) / to_light[2];
  return std::min(ambient + (1 - ambient) * light, 1.0f);
}

/// Bounds in pixels.
struct SolidPainter::Extent {
  float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f, far = 1e30f, near = -1e30f;

  void add(float x, float y, float z, float radius) {
    left = std::min(left, x - radius), right = std::max(right, x + radius);
    top = std::min(top, y - radius), bottom = std::max(bottom, y + radius);
    far = std::min(far, z - radius), near = std::max(near, z + radius);
  }
  float range() const { return std::max(near - far, 1e-3f) * 1.001f; }  // farthest point is not background
};

SolidPainter::SolidPainter(int image_width, int image_height, const Rect& plot, Rgb background,
                           bool transparent)
    : image_width_(image_width),
      image_height_(image_height),
      plot_(plot),
      background_{background[0] / 255.0f, background[1] / 255.0f, background[2] / 255.0f},
      opacity_(transparent ? 0.0f : 1.0f),
      reach_(std::max(6, std::min(plot.width, plot.height) / 24)),
      band_height_(
          std::clamp(samples_per_band / (samples * samples * plot.width) - 2 * reach_, 1, plot.height)) {
  if (transparent) background_ = {};
  const int width = samples * plot_.width;
  const int height = samples * std::min(band_height_ + 2 * reach_, plot_.height);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  color_ = make_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_LINEAR, width, height);
  depth_ = make_texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_NEAREST, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    fail_for_memory(image_width, image_height);
  const auto make_shape = [](Shape& shape, const char* vertex, const char* fragment, int floats, int shades,
                             std::size_t stride) {
    shape.program = make_program(vertex, fragment);
    shape.band_uniform = glGetUniformLocation(shape.program, "band");
    shape.depth_uniform = glGetUniformLocation(shape.program, "depth");
    glGenVertexArrays(1, &shape.vertices);
    glGenBuffers(1, &shape.buffer);
    glBindVertexArray(shape.vertices);
    glBindBuffer(GL_ARRAY_BUFFER, shape.buffer);
    declare_attributes(floats, shades, stride);
  };
  make_shape(ball_, ball_vertex_shader, ball_fragment_shader, 4, 0, sizeof(Ball));
  make_shape(triangle_, triangle_vertex_shader, triangle_fragment_shader, 3, 0, sizeof(Corner));
  make_shape(surface_, surface_vertex_shader, surface_fragment_shader, 3, 2, sizeof(SurfaceCorner));
  resolve_program_ = make_program(resolve_vertex_shader, resolve_fragment_shader);
  glGenVertexArrays(1, &no_vertices_);
  glDepthFunc(GL_LESS);
}

void SolidPainter::draw(std::uint32_t picture, const SolidParts& parts) {
  const auto& [balls, corners, surface, palette] = parts;
  glBindFramebuffer(GL_FRAMEBUFFER, picture);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(background_[0], background_[1], background_[2], opacity_);
  glClear(GL_COLOR_BUFFER_BIT);
  Extent extent;
  for (const Ball& ball : balls) extent.add(ball.x, ball.y, ball.z, ball.radius);
  for (const Corner& corner : corners) extent.add(corner.x, corner.y, corner.z, 0);
  for (const SurfaceCorner& corner : surface) extent.add(corner.x, corner.y, corner.z, 0);
  if (balls.empty() && corners.empty() && surface.empty()) return;
  std::vector<Ball> thrice;
  thrice.reserve(3 * balls.size());
  for (const Ball& ball : balls) thrice.insert(thrice.end(), 3, ball);
  glBindBuffer(GL_ARRAY_BUFFER, ball_.buffer);
  fill_buffer(thrice.data(), thrice.size() * sizeof(Ball), ball_.capacity);
  glBindBuffer(GL_ARRAY_BUFFER, triangle_.buffer);
  fill_buffer(corners.data(), corners.size_bytes(), triangle_.capacity);
  if (!surface.empty()) {
    glBindBuffer(GL_ARRAY_BUFFER, surface_.buffer);
    fill_buffer(surface.data(), surface.size_bytes(), surface_.capacity);
    if (palette_ == 0)
      palette_ = make_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_NEAREST,
                              static_cast<int>(palette.size()), 1, palette.data());
  }
  ball_.count = static_cast<int>(thrice.size());
  triangle_.count = static_cast<int>(corners.size());
  surface_.count = static_cast<int>(surface.size());
  for (int top = 0; top < plot_.height; top += band_height_) {
    const int height = std::min(band_height_, plot_.height - top);
    const int above = std::min(reach_, top), below = std::min(reach_, plot_.height - top - height);
    draw_band(top - above, above + height + below, extent);
    resolve(picture, top, height, below, extent);
  }
}

void SolidPainter::draw_band(int top, int height, const Extent& extent) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, samples * plot_.width, samples * height);
  glClearColor(background_[0], background_[1], background_[2], 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  for (const Shape* shape : {&ball_, &triangle_, &surface_}) {
    if (shape->count == 0) continue;
    if (shape == &surface_) {
      glActiveTexture(GL_TEXTURE0);
      glBindTexture(GL_TEXTURE_2D, palette_);
    }
    glUseProgram(shape->program);
    glUniform3f(shape->band_uniform, static_cast<float>(plot_.width), static_cast<float>(top),
                static_cast<float>(height));
    glUniform2f(shape->depth_uniform, extent.near, 1 / extent.range());
    glBindVertexArray(shape->vertices);
    glDrawArrays(GL_TRIANGLES, 0, shape->count);
  }
}

/// Shades rows from `top`; the band has `below` further rows under them.
void SolidPainter::resolve(std::uint32_t picture, int top, int height, int below, const Extent& extent) {
  const int bottom = image_height_ - (plot_.y + top + height);
  glBindFramebuffer(GL_FRAMEBUFFER, picture);
  glViewport(0, 0, image_width_, image_height_);
  glDisable(GL_DEPTH_TEST);
  const auto within = [](float value, int most) {
    return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(most)));
  };
  const int left = within(extent.left - 1, plot_.width), right = within(extent.right + 2, plot_.width);
  const int first = std::max(within(extent.top - 1, plot_.height), top);
  const int last = std::min(within(extent.bottom + 2, plot_.height), top + height);
  if (right <= left || last <= first) return;
  glEnable(GL_SCISSOR_TEST);
  glScissor(plot_.x + left, bottom + (top + height - last), right - left, last - first);
  const GLuint program = resolve_program_;
  glUseProgram(program);
  for (const auto& [unit, texture] : {std::pair(0, color_), std::pair(1, depth_)}) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
  }
  glUniform1i(glGetUniformLocation(program, "colors"), 0);
  glUniform1i(glGetUniformLocation(program, "depths"), 1);
  glUniform2i(glGetUniformLocation(program, "corner"), plot_.x, bottom - below);
  const int above = std::min(reach_, top);
  glUniform2i(glGetUniformLocation(program, "top_edge"), samples * plot_.width - 1,
              samples * (above + height + below) - 1);
  glUniform1f(glGetUniformLocation(program, "range"), extent.range());
  glUniform1f(glGetUniformLocation(program, "reach"), static_cast<float>(reach_));
  glUniform3f(glGetUniformLocation(program, "background"), background_[0], background_[1], background_[2]);
  glUniform1f(glGetUniformLocation(program, "opacity"), opacity_);
  glBindVertexArray(no_vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace taut::render
