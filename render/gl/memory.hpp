#pragma once

namespace taut::render {

/// Throws UsageError.
[[noreturn]] void fail_for_memory(int width, int height);

/// Throws UsageError without enough memory. Required before each picture: Mesa may crash.
void check_memory(int width, int height);

}  // namespace taut::render
