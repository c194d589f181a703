#include "report_pool.hpp"

#include <graze/error.hpp>

namespace graze {

ReportPool::ReportPool() {
  (void)begin();
  slot(filling_).references.store(bias, std::memory_order_relaxed);
  current_.store(std::uint64_t{filling_} << count_bits, std::memory_order_release);
}

void ReportPool::close() {
  retire(current_.load(std::memory_order_acquire));
  // The analyzer takes a retired slot's owner for the scene, which is one until here.
  drop_owner();  // NOLINT(clang-analyzer-cplusplus.NewDelete)
}

ReportHandle ReportPool::latest() noexcept {
  // Acquire: what the publisher wrote into the slot, and the slot's chunk, are visible.
  const std::uint64_t taken = current_.fetch_add(1, std::memory_order_acquire);
  const auto index = static_cast<std::uint32_t>(taken >> count_bits);
  return {this, index, &slot(index).report};
}

FrameReport& ReportPool::begin() {
  const auto published = static_cast<std::uint32_t>(current_.load(std::memory_order_relaxed) >> count_bits);
  // Acquire: the last handle's reads are over before the slot is written again.
  const bool any_free = free_count_.load(std::memory_order_acquire) > 0;
  for (std::uint32_t index = 0; any_free && index < slot_count_; ++index)
    if (index != published && slot(index).references.load(std::memory_order_acquire) == 0) {
      free_count_.fetch_sub(1, std::memory_order_relaxed);
      filling_ = index;
      return slot(index).report;
    }
  if (slot_count_ == chunk_size * chunk_capacity)
    throw Error("scene: " + std::to_string(slot_count_) +
                " reports are held by handles; let some go before the next step");
  if (slot_count_ % chunk_size == 0) chunks_[slot_count_ / chunk_size] = std::make_unique<Chunk>();
  filling_ = slot_count_++;
  return slot(filling_).report;
}

ReportHandle ReportPool::publish() noexcept {
  slot(filling_).references.store(bias, std::memory_order_relaxed);
  retire(current_.exchange(std::uint64_t{filling_} << count_bits, std::memory_order_acq_rel));
  return latest();  // NOLINT(clang-analyzer-cplusplus.NewDelete): the scene owns the pool while it steps
}

void ReportPool::retire(std::uint64_t taken) noexcept {
  const auto index = static_cast<std::uint32_t>(taken >> count_bits);
  const std::int64_t change = static_cast<std::int64_t>(taken & count_mask) - bias;
  owners_.fetch_add(1, std::memory_order_relaxed);
  if (slot(index).references.fetch_add(change, std::memory_order_acq_rel) + change == 0) was_freed();
}

void ReportPool::release(std::uint32_t index) noexcept {
  // Release: this handle's reads are over; acquire, should it be the last: so are all others'.
  if (slot(index).references.fetch_sub(1, std::memory_order_acq_rel) == 1) was_freed();
}

void ReportPool::was_freed() noexcept {
  free_count_.fetch_add(1, std::memory_order_release);
  drop_owner();
}

void ReportPool::drop_owner() noexcept {
  if (owners_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
}

ReportHandle::ReportHandle(const ReportHandle& other)
    : pool_(other.pool_), slot_(other.slot_), report_(other.report_) {
  if (pool_ != nullptr) pool_->add_reference(slot_);
}

ReportHandle::~ReportHandle() {
  if (pool_ != nullptr) pool_->release(slot_);
}

}  // namespace graze
