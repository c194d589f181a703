#include "jobs/nearest_contacts.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// The least number of contacts beyond the limit that are gathered before the nearest are selected.
constexpr std::size_t least_to_spare = 1024;

/// How many contacts are gathered until the nearest are selected.
std::size_t room_for_limit(std::size_t most) {
  return most + std::max(most, least_to_spare);
}

}  // namespace

void NearestContacts::begin(std::size_t most, ContactDetail detail) {
  most_ = most;
  detail_ = detail;
  contacts_.clear();
  jobs_.clear();
  limit_ = std::numeric_limits<double>::infinity();
}

void NearestContacts::add(std::uint32_t job, std::span<const Contact> contacts) {
  const std::lock_guard lock(mutex_);
  const std::size_t room = room_for_limit(most_);
  for (const Contact& contact : contacts) {
    if (rank_of(contact) > limit_) continue;
    if (contacts_.size() == room) keep_nearest();
    if (rank_of(contact) > limit_) continue;
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
    if (rank_of(a) != rank_of(b)) return rank_of(a) < rank_of(b);
    return jobs_[left] != jobs_[right] ? jobs_[left] < jobs_[right] : contact_order(a) < contact_order(b);
  });
  limit_ = rank_of(contacts_[*(end - 1)]);
  // The order in which they were added is restored: the contacts of a job stay adjacent and sorted.
  std::sort(order_.begin(), end);
  for (std::size_t i = 0; i < most_; ++i) {
    contacts_[i] = contacts_[order_[i]];
    jobs_[i] = jobs_[order_[i]];
  }
  contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(most_), contacts_.end());
  jobs_.resize(most_);
}

void NearestContacts::reserve(std::size_t most, std::size_t contacts) {
  const std::size_t room = std::min(contacts, room_for_limit(most));
  contacts_.reserve(room);
  jobs_.reserve(room);
  order_.reserve(room);
}

std::size_t NearestContacts::byte_count() const {
  return bytes_of(contacts_) + bytes_of(jobs_) + bytes_of(order_);
}

}  // namespace graze
