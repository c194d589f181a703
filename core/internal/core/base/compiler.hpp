#pragma once

// What graze uses of the compiler beyond C++20. GCC and clang have it. For other compilers each has a
// portable form beside it. GRAZE_PORTABLE (a CMake option) takes the portable forms with every compiler, so
// that they are tested where there is no other (docs/platforms.md). Kernels have more in kernels/vectors.hpp.

#if defined(__GNUC__) && !defined(GRAZE_PORTABLE)
#define GRAZE_EXTENSIONS 1
#define GRAZE_ALWAYS_INLINE [[gnu::always_inline]]
#define GRAZE_NEVER_INLINE [[gnu::noinline]]
#else
#define GRAZE_EXTENSIONS 0
#define GRAZE_ALWAYS_INLINE
#define GRAZE_NEVER_INLINE
#endif
