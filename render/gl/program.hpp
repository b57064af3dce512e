#pragma once

#include <cstdint>

namespace taut::render {

/// Requires a current context.
std::uint32_t make_program(const char* vertex_shader, const char* fragment_shader);

/// Fills the bound buffer, which may grow.
void fill_buffer(const void* data, std::size_t bytes, std::size_t& capacity);

}  // namespace taut::render
