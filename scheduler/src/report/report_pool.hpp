#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <graze/report.hpp>
#include <memory>
#include <vector>

#include "report/report_builder.hpp"

namespace graze {

/// The reports of one scene. One is published, any number are still held by handles, and the rest are free to
/// be filled again.
///
/// `current_` holds the published slot and, in its low bits, how many handles were taken of it. So taking a
/// handle is a single fetch_add without a retry or a lock. A slot's `references` starts at `bias` when the
/// slot is published, and each destroyed handle subtracts 1. When the slot is retired, the number of handles
/// taken is added and the bias subtracted. It is 0 exactly when the slot is retired and no handle is left.
/// Only the stepping thread looks for such slots and fills them again. So a reader that sleeps costs one
/// slot, and nobody waits for it.
///
/// A report may show the rows of an earlier report, its lender. The lender's slot is filled again only when
/// no readable report shows its rows. So a lender that nobody holds takes a slot. Where slots were reserved
/// there is one for that, and with a second lender rows are copied instead. Only the stepping thread keeps
/// count of loans.
///
/// The pool lives until its scene and all handles are gone: `owners_` counts the scene and every retired slot
/// that is still referenced.
class ReportPool {
 public:
  /// Creates a pool that has published an empty report of frame 0.
  static ReportPool* create() { return new ReportPool; }
  /// Ends the scene's ownership. Handles stay valid.
  void close();

  /// The published report. Any thread may call this while the scene lives. It is wait-free.
  [[nodiscard]] ReportHandle latest() noexcept;

  /// Returns a report that nobody reads, to be filled. Stepping thread only. Throws Error if all slots are
  /// held, and std::bad_alloc. Nothing has begun then.
  [[nodiscard]] FrameReport& begin();
  /// Gives up the report of the last `begin`, and frees the memory of all reports that nobody reads.
  void cancel() noexcept;
  /// Makes the report of the last `begin` have the rows of the published one. Only the stepping thread calls
  /// this and the members below.
  void repeat_rows();
  /// Gives every report that nobody reads the capacity that any report has needed, and the others once their
  /// handles are gone. Then a step like an earlier one allocates nothing, whichever report is next. Without
  /// time for this now, a later call does it.
  void equalize_capacity(bool has_time);
  /// Reserves room for that many held reports beside the published one, each of that capacity.
  void reserve(std::size_t held, const ReportRoom& room);
  /// The bytes of all reports, as of the last `equalize_capacity`.
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
    bool is_keeping = false;         ///< it is listed in keeping_
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
  [[nodiscard]] bool may_lend(std::uint32_t index);
  void end_loans();
  void end_loan(std::uint32_t index);
  void release_kept();
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
  /// The number of slots that can be filled again. While it is 0 no search is needed.
  std::atomic<std::uint32_t> free_count_{0};
  // A chunk is written before any of its slots is published, and read only through an index from `current_`.
  std::array<std::unique_ptr<Chunk>, chunk_capacity> chunks_;
  std::uint32_t slot_count_ = 0;
  std::uint32_t filling_ = 0;
  std::uint32_t loan_count_ = 0;    ///< slots that have a lender
  std::uint32_t lender_count_ = 0;  ///< slots that are one
  bool is_reserved_ = false;        ///< slots were reserved
  /// The slots whose reports may share something with others. There is room for all slots.
  std::vector<std::uint32_t> keeping_;
  std::size_t next_keeping_ = 0;  ///< in keeping_, the one that was looked at last
  ReportRoom room_;               ///< that every report gets when nobody reads it
  bool all_have_room_ = true;
  std::size_t byte_count_ = sizeof(ReportPool);
};

}  // namespace graze
