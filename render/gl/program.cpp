#include "render/gl/program.hpp"

#include <stdexcept>
#include <string>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

namespace taut::render {
namespace {

GLuint compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char log[1024] = {};
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("a shader does not compile: ") + log);
}

}  // namespace

std::uint32_t make_program(const char* vertex_shader, const char* fragment_shader) {
  const GLuint program = glCreateProgram();
  const GLuint parts[] = {compile(GL_VERTEX_SHADER, vertex_shader),
                          compile(GL_FRAGMENT_SHADER, fragment_shader)};
  for (const GLuint part : parts) glAttachShader(program, part);
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("the shaders do not link");
  for (const GLuint part : parts) glDeleteShader(part);
  return program;
}

void fill_buffer(const void* data, std::size_t bytes, std::size_t& capacity) {
  if (bytes > capacity) {
    capacity = bytes;
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  } else if (bytes > 0) {
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  }
}

}  // namespace taut::render
