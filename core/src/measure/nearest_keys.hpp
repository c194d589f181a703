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
  void reserve(const PairRoom& /*room*/) {}  // where there is a limit, memory is taken when it is met
};

/// The nearest of the contacts of a pair of surfaces, which are met in any order and several times, so many
/// at most: by their distance as it is reported, and of those that are as near by their keys. What is kept
/// does not depend on the order in which contacts are met, nor by which thread.
///
/// Of the keys of one pair of features the nearest stands for all, as in `keep_nearest_of_each`. One that is
/// further than as many others as are kept stays out whatever comes later, and so do all that are further
/// than it: dropping it at once loses nothing.
class NearestKeys {
 public:
  /// Forgets all; of the next pair at most so many are kept, at least one.
  void begin(std::size_t most);
  /// Takes sorted keys, each once, of each pair of features the nearest. Any number of threads at once.
  void add(const SurfacePair& pair, std::span<const FeaturePairKey> keys, MeasureScratch& measure,
           NearestKeysScratch& scratch);
  /// What is not nearer than this is not kept: a little more than the furthest that is, by what reported
  /// distances are rounded. Any thread; it shrinks meanwhile.
  [[nodiscard]] double limit(const SurfacePair& pair);

  // When all have been added:

  /// Whether there were more, after `finish`.
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  /// Puts those that are kept, sorted, into `keys`; and the lowest of those at the very least distance, if
  /// there is one, into `nearest`: it need not be among the first of those that are reported to be as near.
  void finish(const SurfacePair& pair, std::vector<FeaturePairKey>& keys, Closest& nearest);

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
  std::vector<Found> found_;  ///< up to twice as many as are kept
  double limit_ = std::numeric_limits<double>::infinity();
  bool is_cut_ = false;
  Closest nearest_;
  double least_ = std::numeric_limits<double>::infinity();  ///< of the distances as reported
};

}  // namespace graze
