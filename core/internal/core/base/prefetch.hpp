#pragma once

namespace graze {

/// Asks the processor to fetch what is read soon. Where a compiler has no way to say so it does nothing.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

}  // namespace graze
