#include "measure/nearest_keys.hpp"

#include <algorithm>

#include "base/working_memory.hpp"
#include "core/base/bytes_of.hpp"
#include "core/base/growth_policy.hpp"
#include "core/mesh/pair_room.hpp"

namespace graze {
namespace {

/// The least number of contacts gathered beyond those to keep, before the nearest are chosen.
constexpr std::size_t least_to_spare = 1024;

/// How many contacts are gathered until the nearest are chosen.
std::size_t room_for(std::size_t most) {
  return most + std::max(most, least_to_spare);
}

/// More than the rounding of reported distances of two surfaces.
double rounding_of(const SurfacePair& pair, double distance) {
  const double size =
      (pair.a.box().max - pair.a.box().min).maxCoeff() + (pair.b.box().max - pair.b.box().min).maxCoeff();
  return (size + distance) * 0x1p-44 + std::numeric_limits<double>::min();
}

}  // namespace

void NearestKeys::begin(std::size_t most) {
  most_ = most;
  found_.clear();
  limit_ = least_ = std::numeric_limits<double>::infinity();
  is_cut_ = false;
  nearest_.clear();
}

double NearestKeys::limit(const SurfacePair& pair) {
  const std::lock_guard lock(mutex_);
  return limit_ + rounding_of(pair, limit_);
}

void NearestKeys::add(const SurfacePair& pair, std::span<const FeaturePairKey> keys, MeasureScratch& measure,
                      NearestKeysScratch& scratch) {
  resize_to_overwrite(scratch.contacts, keys.size());
  graze::measure(pair, keys, scratch.contacts, measure);
  const std::lock_guard lock(mutex_);
  for (const Contact& contact : scratch.contacts) least_ = std::min(least_, contact.distance);
  const double may_be_nearest = least_ + rounding_of(pair, least_);
  ClosestSet nearest(pair, Ties::lowest, nearest_);
  const std::size_t room = room_for(most_);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double distance = scratch.contacts[i].distance;
    if (distance <= may_be_nearest) nearest.offer(keys[i]);
    if (distance > limit_) continue;
    if (found_.size() == room) keep_nearest(pair);
    if (distance <= limit_) found_.push_back({distance, keys[i]});
  }
}

void NearestKeys::keep_nearest(const SurfacePair& pair) {
  drop_doubles(pair);
  if (found_.size() <= most_) return;
  is_cut_ = true;
  const auto last = found_.begin() + static_cast<std::ptrdiff_t>(most_) - 1;
  std::nth_element(found_.begin(), last, found_.end(), [](const Found& left, const Found& right) {
    return left.distance != right.distance ? left.distance < right.distance : left.key < right.key;
  });
  limit_ = last->distance;
  found_.erase(last + 1, found_.end());
}

/// Leaves of each pair of features the nearest, sorted by key.
void NearestKeys::drop_doubles(const SurfacePair& pair) {
  std::sort(found_.begin(), found_.end(),
            [](const Found& left, const Found& right) { return left.key < right.key; });
  std::size_t kept = 0;
  for (const Found& found : found_) {
    pair.check_time();
    if (kept == 0 || !found_[kept - 1].key.same_features(found.key))
      found_[kept++] = found;
    else if (found_[kept - 1].key != found.key &&
             compare_distances(pair, found.key, found_[kept - 1].key) < 0)
      found_[kept - 1] = found;
  }
  found_.resize(kept);
}

void NearestKeys::finish(const SurfacePair& pair, std::vector<FeaturePairKey>& keys, Closest& nearest) {
  keep_nearest(pair);
  std::sort(found_.begin(), found_.end(),
            [](const Found& left, const Found& right) { return left.key < right.key; });
  keys.clear();
  for (const Found& found : found_) keys.push_back(found.key);
  nearest.clear();
  if (!nearest_.keys.empty()) nearest.keys.assign(nearest_.keys.front());
}

void NearestKeys::reserve(std::size_t most, std::size_t keys) {
  found_.reserve(std::min(keys, room_for(most)));
  PairRoom of_lowest;
  of_lowest.ties = 1;
  graze::reserve(nearest_, of_lowest);
}

void NearestKeys::reserve_as(const NearestKeys& other) {
  found_.reserve(other.found_.capacity());
  graze::reserve_as(nearest_, other.nearest_);
}

std::size_t NearestKeys::byte_count() const {
  return bytes_of(found_) + bytes_of(nearest_);
}

}  // namespace graze
