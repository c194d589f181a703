#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "core/pair/contact_rank.hpp"

namespace graze {

/// Keeps the contacts of lowest rank of all jobs of a step, up to a limit, ordered by (contact_rank, job,
/// kind and features). These are the nearest, or with ContactDetail::nearest the deepest. What it keeps does
/// not depend on the order in which jobs are answered. A contact is left out once as many of lower rank as
/// the limit have been added.
class NearestContacts {
 public:
  /// Forgets all contacts and sets the limit; 0 keeps none.
  void begin(std::size_t most, ContactDetail detail);
  /// Adds copies of a job's contacts, which are sorted by their features. Any number of threads may call this
  /// at once.
  void add(std::uint32_t job, std::span<const Contact> contacts);
  /// Call this when all contacts have been added. Calls `visit(job, contacts)` for each job of which contacts
  /// are kept. These contacts are sorted by their features and stay until the next `begin`.
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
  /// Makes room for steps with so many contacts, of which at most `most` are kept.
  void reserve(std::size_t most, std::size_t contacts);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  [[nodiscard]] double rank_of(const Contact& contact) const { return contact_rank(detail_, contact); }
  void keep_nearest();

  std::mutex mutex_;  ///< guards all members below while contacts are added
  std::size_t most_ = 0;
  ContactDetail detail_ = ContactDetail::features;
  std::vector<Contact> contacts_;    ///< the limit and the spare ones at most; those of a job are adjacent
  std::vector<std::uint32_t> jobs_;  ///< the job of each contact
  std::vector<std::uint32_t> order_;
  double limit_ = std::numeric_limits<double>::infinity();  ///< contacts of a higher rank are left out
};

}  // namespace graze
