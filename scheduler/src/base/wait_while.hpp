#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace graze {

/// Waits while an atomic has a value. Whoever changes it calls its notify_one or notify_all.
template <typename Value>
void wait_while(const std::atomic<Value>& atomic, Value value) {
#if defined(__MINGW32__)
  // GCC 12 has no futex there. Its wait looks at the value before it takes its lock, and so may miss the last
  // change: programs stood still in one of three runs.
  constexpr std::chrono::microseconds between_looks(100);
  while (atomic.load(std::memory_order_acquire) == value) std::this_thread::sleep_for(between_looks);
#else
  atomic.wait(value, std::memory_order_acquire);
#endif
}

}  // namespace graze
