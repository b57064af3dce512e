#pragma once

namespace taut::render {

/// Throws UsageError.
[[noreturn]] void fail_for_memory(int width, int height);

/// Throws UsageError without enough memory. Call before each picture: without memory, Mesa can crash instead of
/// reporting an error.
void check_memory(int width, int height);

}  // namespace taut::render
