#pragma once

namespace taut::render {

/// Throws UsageError: no memory for a picture of this size.
[[noreturn]] void fail_for_memory(int width, int height);

/// Throws the same if OpenGL's memory for a picture of this size is not available. Required before each picture: Mesa
/// may crash instead of reporting an error.
void check_memory(int width, int height);

}  // namespace taut::render
