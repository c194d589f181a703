#pragma once

// These macros are what graze uses of GCC and clang beyond C++20. Each has a portable form beside it, for
// other compilers. GRAZE_PORTABLE (a CMake option) takes the portable forms with every compiler, so that
// tests reach them (docs/platforms.md). Kernels have more macros in kernels/vectors.hpp.

#if defined(__GNUC__) && !defined(GRAZE_PORTABLE)
#define GRAZE_EXTENSIONS 1
#define GRAZE_ALWAYS_INLINE [[gnu::always_inline]]
#define GRAZE_NEVER_INLINE [[gnu::noinline]]
#else
#define GRAZE_EXTENSIONS 0
#define GRAZE_ALWAYS_INLINE
#define GRAZE_NEVER_INLINE
#endif
