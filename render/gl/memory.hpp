#pragma once

namespace taut::render {

/// Throws UsageError: not enough memory for a picture of this size.
[[noreturn]] void fail_for_memory(int width, int height);

/// Throws UsageError if there is not enough memory for OpenGL to draw a picture of this size. Call it before each
/// picture: without memory, Mesa can crash instead of reporting an error.
void check_memory(int width, int height);

}  // namespace taut::render
