#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/base/bytes_of.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// The contacts of all pairs of a report: first who has which, in the pairs' order, then they are written, by
/// many threads where there are many. Stepping thread only.
class ContactRows {
 public:
  void begin() {
    pairs_.clear();
    count_ = 0;
  }
  /// The next pair's, found in this step; `last` are its contacts of the last report. Both are sorted by
  /// their features. What is given stays where it is until all are written.
  void add(std::span<const Contact> contacts, std::span<const Contact> last) {
    append({contacts, last, false, count_});
  }
  /// The next pair's, as they were in the last report.
  void add_again(std::span<const Contact> contacts) { append({contacts, {}, true, count_}); }
  /// Of all pairs.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Has the report take a list that is one of those added, where it is most of all: it is not copied then.
  void adopt_list(std::vector<Contact>& list, ReportBuilder& report);
  /// Writes them into `rows`, of which there are `count()`, and since which frame they have been there.
  void write(TaskPool& tasks, std::span<Contact> rows, std::uint64_t frame) const;

  /// Makes room for so many pairs with contacts.
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
