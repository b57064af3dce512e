#pragma once

namespace taut::render {

/// UsageError: there is no memory for a picture of this size.
[[noreturn]] void fail_for_memory(int width, int height);

/// Throws that where what OpenGL takes to draw a picture of this size is not to be had. It is to be asked before
/// each picture: Mesa does not always say
/// so itself, but crashes.
void check_memory(int width, int height);

}  // namespace taut::render
