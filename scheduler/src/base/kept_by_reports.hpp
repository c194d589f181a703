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

  void add_holder() const noexcept { holders_.fetch_add(1, std::memory_order_relaxed); }
  void drop_holder() const noexcept {
    // Release: this holder's reads are over. Acquire: should it be the last, so are all others'.
    if (holders_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
  }
  /// Whether a single holder is left, the caller. Then it may fill this again.
  [[nodiscard]] bool has_one_holder() const noexcept { return holders_.load(std::memory_order_acquire) == 1; }

 protected:
  virtual ~KeptByReports() = default;

 private:
  mutable std::atomic<std::uint32_t> holders_{0};
};

/// What a keeper has made for reports. One is the last that it filled. Reports have some others still, and
/// the rest can be filled again. `Kept` has `clear`, which lets go of what it shares with others.
template <typename Kept>
class KeptPool {
 public:
  /// Clears all that no report has, but for the last one.
  void clear_unused() {
    for (std::size_t index = 0; index < writable_.size(); ++index)
      if (index != last_ && writable_[index]->has_one_holder()) writable_[index]->clear();
  }
  /// One that no report has, which is the last one from now on. It is empty.
  [[nodiscard]] Kept& next() {
    std::size_t index = 0;
    while (index < writable_.size() && !writable_[index]->has_one_holder()) ++index;
    if (index == writable_.size()) {
      auto* const made = new Kept;
      handles_.push_back(KeptHandle<Kept>(made));
      writable_.push_back(made);
    }
    last_ = index;
    writable_[index]->clear();
    return *writable_[index];
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
  std::vector<KeptHandle<Kept>> handles_;
  std::vector<Kept*> writable_;  ///< the same
  std::size_t last_ = 0;
};

}  // namespace graze
