#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <graze/report.hpp>
#include <vector>

namespace graze {

/// Something that reports share. It does not change while one of them has it. A report drops it on the
/// stepping thread, and a copy of a report on any thread.
class KeptByReports {
 public:
  KeptByReports() = default;
  KeptByReports(const KeptByReports&) = delete;
  KeptByReports& operator=(const KeptByReports&) = delete;
  virtual ~KeptByReports() = default;

  void add_holder() const noexcept { holders_.fetch_add(1, std::memory_order_relaxed); }
  void drop_holder() const noexcept {
    // Release: this holder's reads are over. Acquire: should it be the last, so are all others'.
    if (holders_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
  }
  /// Whether a single holder is left, the caller. Then it may fill this again.
  [[nodiscard]] bool has_one_holder() const noexcept { return holders_.load(std::memory_order_acquire) == 1; }

 private:
  mutable std::atomic<std::uint32_t> holders_{0};
};

/// The objects of type `Kept` that a keeper has made for reports. One is the last that it filled. Reports
/// have some others still, and the rest can be filled again. `Kept` has `clear`, which lets go of what it
/// shares with others.
template <typename Kept>
class KeptPool {
 public:
  /// Clears those that no report has, but for the last one. It looks at a few only, so that a step takes no
  /// longer where many reports are held. The next calls look at others.
  void clear_unused() {
    constexpr std::size_t at_once = 8;
    for (std::size_t looked = 0; looked < at_once && looked < writable_.size(); ++looked) {
      next_ = next_ + 1 < writable_.size() ? next_ + 1 : 0;
      if (next_ != last_ && writable_[next_]->has_one_holder()) writable_[next_]->clear();
    }
  }
  /// One that no report has, which is the last one from now on. It is empty.
  [[nodiscard]] Kept& next() {
    last_ = free_index();
    if (last_ == writable_.size()) {
      auto* const made = new Kept;
      handles_.push_back(KeptHandle<Kept>(made));
      writable_.push_back(made);
    }
    writable_[last_]->clear();
    return *writable_[last_];
  }
  [[nodiscard]] bool has_last() const { return last_ < handles_.size(); }
  /// The last one.
  [[nodiscard]] const KeptHandle<Kept>& last() const { return handles_[last_]; }
  [[nodiscard]] std::size_t byte_count() const {
    std::size_t bytes = handles_.capacity() * sizeof(KeptHandle<Kept>) + writable_.capacity() * sizeof(Kept*);
    for (const Kept* const kept : writable_) bytes += kept->byte_count();
    return bytes;
  }

 private:
  /// The index of one that no report has, or their number if there is none. The search begins after the last
  /// one, where the oldest are, which reports let go of first.
  [[nodiscard]] std::size_t free_index() const {
    const std::size_t count = writable_.size();
    for (std::size_t looked = 1; looked <= count; ++looked)
      if (const std::size_t index = (last_ + looked) % count; writable_[index]->has_one_holder())
        return index;
    return count;
  }

  std::vector<KeptHandle<Kept>> handles_;
  std::vector<Kept*> writable_;  ///< the same
  std::size_t last_ = 0;
  std::size_t next_ = 0;  ///< the one that clear_unused looked at last
};

}  // namespace graze
