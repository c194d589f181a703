#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/base/bytes_of.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// The contacts of all pairs of a report. First the pairs are added in their order, then all contacts are
/// written, in parallel if there are many. Stepping thread only.
class ContactRows {
 public:
  void begin() {
    pairs_.clear();
    count_ = 0;
  }
  /// Adds the contacts of the next pair, found in this step. `last` are its contacts in the last report. Both
  /// are sorted by their features and stay valid until all are written.
  void add(std::span<const Contact> contacts, std::span<const Contact> last) {
    append({contacts, last, false, count_});
  }
  /// Adds the contacts of the next pair unchanged from the last report.
  void add_again(std::span<const Contact> contacts) { append({contacts, {}, true, count_}); }
  /// The number of contacts of all pairs.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Lets the report adopt an added list instead of copying it, if the list has at least half of all
  /// contacts.
  void adopt_list(std::vector<Contact>& list, ReportBuilder& report);
  /// Writes all contacts into `rows`, which has `count()` elements, and sets Contact::since. `frame` is the
  /// number of the new report.
  void write(TaskPool& tasks, std::span<Contact> rows, std::uint64_t frame) const;

  /// Reserves memory for that many pairs with contacts.
  void reserve(std::size_t pairs) { pairs_.reserve(pairs); }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(pairs_); }

 private:
  struct Pair {
    std::span<const Contact> contacts;
    std::span<const Contact> last;
    bool is_again;
    std::size_t first;  ///< the index of its first contact
  };
  void append(const Pair& pair) {
    if (pair.contacts.empty()) return;
    pairs_.push_back(pair);
    count_ += pair.contacts.size();
  }
  void write_range(std::span<Contact> rows, std::size_t begin, std::size_t end, std::uint64_t frame) const;

  std::vector<Pair> pairs_;
  std::size_t count_ = 0;
};

}  // namespace graze
