#pragma once

#include <cstddef>
#include <graze/contact.hpp>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "closest_features/closest_set.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "closest_features/key_order.hpp"
#include "measure/measure_batch.hpp"

namespace graze {

/// Working memory of a thread that hands over keys.
struct NearestKeysScratch {
  std::vector<Contact> contacts;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.contacts);
  }
  void reserve(const PairRoom& /*room*/) {}  // by PairDetector::reserve_for_limit, if there is one
};

/// Keeps the nearest contacts of a pair of surfaces, so many at most. They may come in any order and several
/// times. They are compared by their distances as they are reported, and at equal distance by their keys. The
/// result depends neither on the order nor on the thread that a contact comes from.
///
/// The nearest key of a pair of features stands for all its keys, as in `keep_nearest_of_each`. A key that is
/// further than as many others as are kept stays out whatever comes later. So do all that are further, and
/// dropping it at once loses nothing.
class NearestKeys {
 public:
  /// Forgets all. Of the next pair at most so many are kept, at least one.
  void begin(std::size_t most);
  /// Takes sorted keys, each once, of each pair of features the nearest. Any number of threads at once.
  void add(const SurfacePair& pair, std::span<const FeaturePairKey> keys, MeasureScratch& measure,
           NearestKeysScratch& scratch);
  /// The distance from which on contacts are not kept. It is a little more than that of the furthest one
  /// kept, by as much as reported distances are rounded. Any thread may ask. It shrinks meanwhile.
  [[nodiscard]] double limit(const SurfacePair& pair);

  // When all have been added:

  /// Whether there were more, after `finish`.
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  /// Puts the kept keys, sorted, into `keys`. Puts the lowest key at the very least distance, if there is
  /// one, into `nearest`. It need not be among the first of those that are reported to be as near.
  void finish(const SurfacePair& pair, std::vector<FeaturePairKey>& keys, Closest& nearest);

  /// Makes room for pairs of so many keys, of which at most `most` are kept.
  void reserve(std::size_t most, std::size_t keys);
  void reserve_as(const NearestKeys& other);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Found {
    double distance;
    FeaturePairKey key;
  };
  void keep_nearest(const SurfacePair& pair);
  void drop_doubles(const SurfacePair& pair);

  std::mutex mutex_;  ///< guards all that follows while keys are added
  std::size_t most_ = 0;
  std::vector<Found> found_;                                ///< up to twice as many as are kept
  double limit_ = std::numeric_limits<double>::infinity();  ///< further contacts are left out
  bool is_cut_ = false;
  Closest nearest_;
  double least_ = std::numeric_limits<double>::infinity();  ///< of the distances as reported
};

}  // namespace graze
