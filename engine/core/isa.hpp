#pragma once

// The solver is compiled once for every instruction set it is tuned for (see engine/CMakeLists.txt). All
// that it inlines lives in a namespace of that name, so that the linker cannot mix the copies.
#ifndef TAUT_ISA
#define TAUT_ISA baseline
#if defined(__x86_64__)
#define TAUT_KNOWS_X86_64_LEVELS  // what is built for any machine chooses, and knows the others
#endif
#endif

// After the parameters of a lambda that is the body of a pass: all that it calls is inlined. Left to itself,
// the compiler calls a term of a dozen vector operations, and hands each of them over through memory.
#define TAUT_FLATTEN __attribute__((flatten))
