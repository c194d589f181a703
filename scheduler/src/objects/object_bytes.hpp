#pragma once

#include <atomic>
#include <cstddef>

#include "objects/object.hpp"

namespace graze {

/// The bytes that all surfaces of a scene hold, with what belongs to them. Who makes a surface grow counts it
/// again, so that no step has to walk all objects for it.
class ObjectBytes {
 public:
  /// Counts an object again. Tasks may count different objects at the same time.
  void count(Object& object);
  /// Leaves out an object that is removed.
  void leave_out(const Object& object) { sum_.fetch_sub(object.counted_bytes, std::memory_order_relaxed); }
  [[nodiscard]] std::size_t sum() const { return sum_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::size_t> sum_ = 0;
};

}  // namespace graze
