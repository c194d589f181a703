#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <graze/report.hpp>
#include <memory>

#include "report/report_builder.hpp"

namespace graze {

/// The reports of one scene: one published, any number still held by handles, the rest to be used again.
///
/// `current_` holds the published slot and, in its low bits, how many handles were taken of it, so that
/// taking one is a single fetch_add: no retry, no lock. A slot's `references` starts at `bias` when it is
/// published, goes down by one with each handle destroyed, and when the slot is retired gets the number of
/// handles taken added and the bias taken away; it is zero exactly when the slot is retired and no handle is
/// left. Only the stepping thread looks for such slots and fills them again, so a reader that sleeps costs
/// one slot and nobody waits for it.
///
/// A report may show the rows of an earlier one, its lender, whose slot is filled again only when no report
/// that can still be read shows them. The stepping thread alone keeps count of that.
///
/// The pool lives until its scene is gone and every handle is: `owners_` counts the scene and every retired
/// slot that is still referenced.
class ReportPool {
 public:
  /// With an empty report of frame 0 published.
  static ReportPool* create() { return new ReportPool; }
  /// The scene's end. Handles stay valid.
  void close();

  /// The published report. Wait-free, from any thread while the scene lives.
  [[nodiscard]] ReportHandle latest() noexcept;

  /// A report that nobody reads, to be filled. Stepping thread only. Throws Error when all slots are held,
  /// and std::bad_alloc; nothing has begun then.
  [[nodiscard]] FrameReport& begin();
  /// Gives up filling the report of the last `begin`, and lets go of the memory of all that nobody reads.
  void cancel() noexcept;
  /// Has the report of the last `begin` show the rows of the published one. Stepping thread only, as is all
  /// that follows.
  void repeat_rows();
  /// Gives every report that nobody reads as much room as any has needed, the others as soon as they are let
  /// go of: whichever is next, a step like an earlier one takes no memory. Where there is no time for that
  /// now, a later call does it.
  void equalize_capacity(bool has_time);
  /// Makes room for so many reports held at once, beside the published one, of that size.
  void reserve(std::size_t held, const ReportRoom& room);
  /// Of all reports, as of the last `equalize_capacity`.
  [[nodiscard]] std::size_t byte_count() const { return byte_count_; }

  /// Publishes the report of the last `begin`.
  ReportHandle publish() noexcept;

  ReportPool(const ReportPool&) = delete;
  ReportPool& operator=(const ReportPool&) = delete;

 private:
  friend class ReportHandle;

  static constexpr std::uint32_t no_slot = ~std::uint32_t{0};
  struct Slot {
    FrameReport report;
    std::atomic<std::int64_t> references{0};
    std::size_t counted_bytes = 0;   ///< its part of byte_count_
    std::uint32_t lender = no_slot;  ///< whose rows its report shows, where they are not its own
    std::uint32_t borrowers = 0;     ///< slots whose lender it is
  };
  static constexpr std::uint32_t chunk_size = 64;
  static constexpr std::uint32_t chunk_capacity = 1024;
  static constexpr std::uint32_t slot_limit = chunk_size * chunk_capacity;
  static constexpr int count_bits = 40;
  static constexpr std::uint64_t count_mask = (std::uint64_t{1} << count_bits) - 1;
  static constexpr std::int64_t bias = std::int64_t{1} << 50;
  using Chunk = std::array<Slot, chunk_size>;

  ReportPool();
  ~ReportPool() = default;

  Slot& slot(std::uint32_t index) { return (*chunks_[index / chunk_size])[index % chunk_size]; }
  void add_reference(std::uint32_t index) noexcept {
    slot(index).references.fetch_add(1, std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint32_t published() const noexcept {
    return static_cast<std::uint32_t>(current_.load(std::memory_order_relaxed) >> count_bits);
  }
  [[nodiscard]] bool is_unread(std::uint32_t index);
  [[nodiscard]] bool is_free(std::uint32_t index);
  void end_loans();
  void end_loan(std::uint32_t index);
  [[nodiscard]] std::uint32_t find_free();
  [[nodiscard]] bool has_room(std::uint32_t index);
  std::uint32_t add_slot();
  void make_room(std::uint32_t index);
  void count_bytes(std::uint32_t index);
  void release(std::uint32_t index) noexcept;
  void retire(std::uint64_t taken) noexcept;
  void was_freed() noexcept;
  void drop_owner() noexcept;

  std::atomic<std::uint64_t> current_{0};
  std::atomic<std::int64_t> owners_{1};
  /// Slots that can be filled again; a look through them all is saved while there are none.
  std::atomic<std::uint32_t> free_count_{0};
  // A chunk is written before any slot of it is published, and read only through an index taken from
  // `current_`.
  std::array<std::unique_ptr<Chunk>, chunk_capacity> chunks_;
  std::uint32_t slot_count_ = 0;
  std::uint32_t filling_ = 0;
  std::uint32_t loan_count_ = 0;  ///< slots that have a lender
  ReportRoom room_;               ///< that every report gets when nobody reads it
  bool all_have_room_ = true;
  std::size_t byte_count_ = sizeof(ReportPool);
};

}  // namespace graze
