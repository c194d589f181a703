#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

namespace graze {

/// A value that is made when it is first asked for, by any thread. Copies share it.
template <typename Value>
class MadeOnce {
 public:
  template <typename Make>
  [[nodiscard]] const Value& get(const Make& make) const {
    if (const Value* const made = if_made()) return *made;
    std::call_once(shared_->once, [&] {
      shared_->value.emplace(make());
      shared_->made.store(true, std::memory_order_release);
    });
    return *shared_->value;
  }
  /// Null before it is made.
  [[nodiscard]] const Value* if_made() const {
    // Acquire: who sees the mark sees the value, too.
    return shared_->made.load(std::memory_order_acquire) ? &*shared_->value : nullptr;
  }

 private:
  struct Shared {
    std::once_flag once;
    std::atomic<bool> made{false};
    std::optional<Value> value;
  };
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace graze
