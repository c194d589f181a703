#include "report/report_pool.hpp"

#include <algorithm>
#include <graze/error.hpp>
#include <string>
#include <utility>

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
  end_loans();
  release_kept();
  const std::uint32_t found = find_free();
  if (found == slot_limit && slot_count_ == slot_limit)
    throw Error("scene: " + std::to_string(slot_count_) +
                " reports are held by handles; let some go before the next step");
  const std::uint32_t free = found == slot_limit ? add_slot() : found;
  make_room(free);
  // From here on nothing throws.
  filling_ = free;
  free_count_.fetch_sub(1, std::memory_order_relaxed);
  end_loan(free);  // its last reader may have let it go just now
  return slot(free).report;
}

void ReportPool::cancel() noexcept {
  end_loan(filling_);
  free_count_.fetch_add(1, std::memory_order_relaxed);
  room_ = {};
  all_have_room_ = true;
  for (std::uint32_t index = 0; index < slot_count_; ++index) {
    if (!is_free(index)) continue;
    ReportBuilder(slot(index).report).release();
    count_bytes(index);
  }
}

void ReportPool::repeat_rows() {
  const std::uint32_t last = published();
  const std::uint32_t lender = slot(last).lender == no_slot ? last : slot(last).lender;
  if (!may_lend(lender)) return ReportBuilder(slot(filling_).report).copy_rows_of(slot(last).report);
  slot(filling_).lender = lender;
  if (++slot(lender).borrowers == 1) ++lender_count_;
  ++loan_count_;
  ReportBuilder(slot(filling_).report).show_rows_of(slot(last).report);
}

/// Whether rows of a slot may be shown by another one, so that it keeps its own as long.
bool ReportPool::may_lend(std::uint32_t index) {
  return !is_reserved_ || slot(index).borrowers > 0 || lender_count_ == 0;
}

/// Ends the loans of all slots that nobody reads.
void ReportPool::end_loans() {
  // While no slot is free there is no loan to end, however many slots are held. A slot that is released just
  // now has its loan ended when it is filled.
  if (free_count_.load(std::memory_order_acquire) == 0) return;
  for (std::uint32_t index = 0; loan_count_ > 0 && index < slot_count_; ++index)
    if (is_unread(index)) end_loan(index);
}

/// Lets go of what the reports that nobody reads share with others. It looks at a few reports only, so that a
/// step takes no longer where many are held. The next steps look at others.
void ReportPool::release_kept() {
  constexpr std::size_t at_once = 8;
  for (std::size_t looked = 0; looked < at_once && looked < keeping_.size(); ++looked) {
    next_keeping_ = next_keeping_ + 1 < keeping_.size() ? next_keeping_ + 1 : 0;
    const std::uint32_t index = keeping_[next_keeping_];
    if (!is_unread(index)) continue;
    ReportBuilder(slot(index).report).release_kept();
    slot(index).is_keeping = false;
    keeping_[next_keeping_] = keeping_.back();
    keeping_.pop_back();
  }
}

void ReportPool::end_loan(std::uint32_t index) {
  const std::uint32_t lender = std::exchange(slot(index).lender, no_slot);
  if (lender == no_slot) return;
  if (--slot(lender).borrowers == 0) --lender_count_;
  --loan_count_;
}

/// Returns a free slot, if possible one with enough room, or slot_limit if none is free.
std::uint32_t ReportPool::find_free() {
  std::uint32_t found = slot_limit;
  // Acquire: the last handle's reads are over before the slot is written again.
  if (free_count_.load(std::memory_order_acquire) == 0) return found;
  for (std::uint32_t index = 0; index < slot_count_; ++index) {
    if (!is_free(index)) continue;
    if (has_room(index)) return index;
    found = std::min(found, index);
  }
  return found;
}

/// Whether nobody reads the slot's report.
bool ReportPool::is_unread(std::uint32_t index) {
  return index != published() && slot(index).references.load(std::memory_order_acquire) == 0;
}

/// Whether nobody reads the slot's report or its rows.
bool ReportPool::is_free(std::uint32_t index) {
  return slot(index).borrowers == 0 && is_unread(index);
}

bool ReportPool::has_room(std::uint32_t index) {
  return ReportBuilder(slot(index).report).room().covers(room_);
}

/// Adds a free slot.
std::uint32_t ReportPool::add_slot() {
  if (slot_count_ % chunk_size == 0) {
    chunks_[slot_count_ / chunk_size] = std::make_unique<Chunk>();
    byte_count_ += sizeof(Chunk);
    keeping_.reserve(std::size_t{slot_count_} + chunk_size);
  }
  free_count_.fetch_add(1, std::memory_order_relaxed);
  return slot_count_++;
}

/// Reserves room in a free slot.
void ReportPool::make_room(std::uint32_t index) {
  ReportBuilder(slot(index).report).reserve(room_);
  count_bytes(index);
}

void ReportPool::count_bytes(std::uint32_t index) {
  const std::size_t bytes = ReportBuilder(slot(index).report).byte_count();
  byte_count_ += bytes - std::exchange(slot(index).counted_bytes, bytes);
}

void ReportPool::equalize_capacity(bool has_time) {
  const ReportRoom needed = ReportBuilder(slot(filling_).report).room();
  if (!room_.covers(needed)) all_have_room_ = false;
  room_.include(needed);
  count_bytes(filling_);
  if (all_have_room_ || !has_time) return;
  bool all_have_room = true;
  for (std::uint32_t index = 0; index < slot_count_; ++index) {
    if (index != filling_ && is_free(index)) make_room(index);
    all_have_room = all_have_room && has_room(index);
  }
  all_have_room_ = all_have_room;
}

void ReportPool::reserve(std::size_t held, const ReportRoom& room) {
  room_.include(room);
  all_have_room_ = false;
  std::size_t with_room = 0;
  for (std::uint32_t index = 0; index < slot_count_; ++index) {
    if (is_free(index)) make_room(index);
    if (has_room(index)) ++with_room;
  }
  is_reserved_ = is_reserved_ || held > 0;
  // Three slots are needed beside the held ones: one is published, one is being filled, and one may lend its
  // rows to others.
  const std::size_t wanted = std::min<std::size_t>(held, slot_limit - 3) + 3;
  for (; with_room < wanted && slot_count_ < slot_limit; ++with_room) make_room(add_slot());
}

ReportHandle ReportPool::publish() noexcept {
  if (!std::exchange(slot(filling_).is_keeping, true)) keeping_.push_back(filling_);
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
  // Release, since this handle's reads are over. Acquire too: should it be the last, so are all others'.
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
