#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

namespace graze {

/// The nearest of the contacts of all jobs of a step, so many at most: by (distance, job, kind and features).
/// What is kept does not depend on the order in which jobs are answered. One that is further than as many
/// others as are kept stays out whatever comes later.
class NearestContacts {
 public:
  /// Forgets all. Of the next at most so many are kept; none is taken where that is 0.
  void begin(std::size_t most);
  /// Takes a copy of a job's contacts, sorted by their features. Any number of threads at once.
  void add(std::uint32_t job, std::span<const Contact> contacts);
  /// When all have been added: calls `visit(job, contacts)` for each job of which some are kept, with these,
  /// sorted as they were, until the next `begin`.
  template <typename Visit>
  void finish(const Visit& visit) {
    keep_nearest();
    for (std::size_t begin = 0; begin < jobs_.size();) {
      std::size_t end = begin + 1;
      while (end < jobs_.size() && jobs_[end] == jobs_[begin]) ++end;
      visit(jobs_[begin], std::span<const Contact>(contacts_).subspan(begin, end - begin));
      begin = end;
    }
  }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void keep_nearest();

  std::mutex mutex_;  ///< guards all that follows while contacts are added
  std::size_t most_ = 0;
  std::vector<Contact> contacts_;    ///< up to twice as many as are kept; those of a job follow each other
  std::vector<std::uint32_t> jobs_;  ///< of each
  std::vector<std::uint32_t> order_;
  double limit_ = std::numeric_limits<double>::infinity();  ///< of the distances that may be kept
};

}  // namespace graze
