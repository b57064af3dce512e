#pragma once

// The solver is compiled once for every instruction set it is tuned for (see engine/CMakeLists.txt). All
// that it inlines lives in a namespace of that name, so that the linker cannot mix the copies.
#ifndef TAUT_ISA
#define TAUT_ISA baseline
#if defined(__x86_64__)
#define TAUT_KNOWS_X86_64_LEVELS  // what is built for any machine chooses, and knows the others
#endif
#endif
