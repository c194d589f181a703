#include "jobs/nearest_contacts.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// The least number of contacts beyond the limit that are gathered before the nearest are selected.
constexpr std::size_t least_to_spare = 1024;

auto features_of(const Contact& contact) {
  return std::tuple(contact.kind, contact.feature_a.kind, contact.feature_a.index, contact.feature_b.kind,
                    contact.feature_b.index);
}

}  // namespace

void NearestContacts::begin(std::size_t most) {
  most_ = most;
  contacts_.clear();
  jobs_.clear();
  limit_ = std::numeric_limits<double>::infinity();
}

void NearestContacts::add(std::uint32_t job, std::span<const Contact> contacts) {
  const std::lock_guard lock(mutex_);
  const std::size_t room = most_ + std::max(most_, least_to_spare);
  for (const Contact& contact : contacts) {
    if (contact.distance > limit_) continue;
    if (contacts_.size() == room) keep_nearest();
    if (contact.distance > limit_) continue;
    contacts_.push_back(contact);
    jobs_.push_back(job);
  }
}

void NearestContacts::keep_nearest() {
  if (contacts_.size() <= most_) return;
  order_.resize(contacts_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(most_);
  std::nth_element(order_.begin(), end - 1, order_.end(), [&](std::uint32_t left, std::uint32_t right) {
    const Contact& a = contacts_[left];
    const Contact& b = contacts_[right];
    if (a.distance != b.distance) return a.distance < b.distance;
    return jobs_[left] != jobs_[right] ? jobs_[left] < jobs_[right] : features_of(a) < features_of(b);
  });
  limit_ = contacts_[*(end - 1)].distance;
  // The order in which they were added is restored: the contacts of a job stay adjacent and sorted.
  std::sort(order_.begin(), end);
  for (std::size_t i = 0; i < most_; ++i) {
    contacts_[i] = contacts_[order_[i]];
    jobs_[i] = jobs_[order_[i]];
  }
  contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(most_), contacts_.end());
  jobs_.resize(most_);
}

std::size_t NearestContacts::byte_count() const {
  return bytes_of(contacts_) + bytes_of(jobs_) + bytes_of(order_);
}

}  // namespace graze
