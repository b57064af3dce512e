#pragma once

#include <cstdint>

namespace taut::render {

/// Requires a current context.
std::uint32_t make_program(const char* vertex_shader, const char* fragment_shader);

/// Copies data into the bound buffer, which grows if `capacity` (bytes) is too small.
void fill_buffer(const void* data, std::size_t bytes, std::size_t& capacity);

}  // namespace taut::render
