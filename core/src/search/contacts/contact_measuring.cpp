#include "search/contacts/contact_measuring.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "closest_features/closest_set.hpp"
#include "measure/measure_batch.hpp"
#include "pair/room_in_time.hpp"

namespace graze {
namespace {

constexpr std::size_t contacts_each = 128;
/// The least time that it takes to measure a contact. Where a deadline leaves less than that for all of them,
/// the rest of the time is for other pairs.
constexpr std::chrono::nanoseconds to_measure_one{40};

}  // namespace

void ContactMeasuring::begin(SearchWorker& worker) {
  const std::size_t count = ordered_.count();
  keep_time_back(count, worker);
  make_room_in_time(pair_.answer->contacts, count, worker.pair.time);
  slices_.clear();
  std::size_t contact = 0;
  for (const Stretch& stretch : ordered_.stretches) {
    const std::size_t first = slices_.size();
    slices_.add_range(stretch.begin, stretch.end, contacts_each);
    for (SearchSlice& slice : slices_.all().subspan(first)) {
      slice.contacts.first = contact;
      contact += slice.end - slice.begin;
    }
  }
}

/// Keeps back the time that the caller needs for so many contacts when they have been measured.
void ContactMeasuring::keep_time_back(std::size_t contacts, SearchWorker& worker) const {
  if (!worker.time.is_set()) return;
  pair_.query.deadline -= contacts * pair_.query.time_after_contact;
  worker.time.set_deadline(pair_.query.deadline);
  worker.time.check_for(contacts * to_measure_one);
}

std::span<const FeaturePairKey> ContactMeasuring::keys_of(const SearchSlice& slice) const {
  return std::span(ordered_.keys).subspan(slice.begin, slice.end - slice.begin);
}

std::span<Contact> ContactMeasuring::contacts_of(const SearchSlice& slice) const {
  return std::span(pair_.answer->contacts).subspan(slice.contacts.first, slice.end - slice.begin);
}

std::span<Contact> ContactMeasuring::run(SearchSlice& slice, SearchWorker& worker) const {
  const std::span<Contact> contacts = contacts_of(slice);
  measure(worker.pair, keys_of(slice), contacts, worker.scratch.measure);
  slice.contacts.nearest = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts)
    slice.contacts.nearest = std::min(slice.contacts.nearest, contact.distance);
  return contacts;
}

FeaturePairKey ContactMeasuring::lowest(SearchWorker& worker) const {
  if (ordered_.lowest) return *ordered_.lowest;
  worker.scratch.lowest.clear();
  ClosestSet closest(worker.pair, Ties::lowest, worker.scratch.lowest);
  const auto slices = slices_.all();
  double nearest = std::numeric_limits<double>::infinity();
  for (const SearchSlice& slice : slices) nearest = std::min(nearest, slice.contacts.nearest);
  // More than the rounding of a contact's distance, which is relative to the size of its features and their
  // gap; those are inside the objects' boxes.
  const double size = (pair_.a->box().max - pair_.a->box().min).maxCoeff() +
                      (pair_.b->box().max - pair_.b->box().min).maxCoeff();
  const auto may_be_nearest = [&](double distance) {
    return distance <= nearest + (size + distance) * 0x1p-44;
  };
  for (const SearchSlice& slice : slices) {
    if (!may_be_nearest(slice.contacts.nearest)) continue;
    const auto keys = keys_of(slice);
    const auto contacts = contacts_of(slice);
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (may_be_nearest(contacts[i].distance)) closest.offer(keys[i]);
  }
  return closest.front();
}

FeaturePairKey lower_of(SearchWorker& worker, const FeaturePairKey& left, const FeaturePairKey& right) {
  worker.scratch.lowest.clear();
  ClosestSet closest(worker.pair, Ties::lowest, worker.scratch.lowest);
  closest.offer(left);
  closest.offer(right);
  return closest.front();
}

}  // namespace graze
