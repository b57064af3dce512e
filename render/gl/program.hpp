#pragma once

#include <cstdint>

namespace taut::render {

/// Shaders from their sources, compiled and linked. A current context is needed.
std::uint32_t make_program(const char* vertex_shader, const char* fragment_shader);

/// Makes the bound buffer hold `bytes` of `data`, in the room that it has if that is enough.
void fill_buffer(const void* data, std::size_t bytes, std::size_t& capacity);

}  // namespace taut::render
