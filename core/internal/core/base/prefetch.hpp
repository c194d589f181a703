#pragma once

#include "core/base/compiler.hpp"

namespace graze {

/// Asks the processor to fetch what is read soon. Where a compiler has no way to say so it does nothing.
inline void prefetch([[maybe_unused]] const void* address) {
#if GRAZE_EXTENSIONS
  __builtin_prefetch(address);
#endif
}

}  // namespace graze
