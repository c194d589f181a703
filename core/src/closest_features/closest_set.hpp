#pragma once

#include <algorithm>
#include <limits>

#include "closest_features/feature_pair_key.hpp"
#include "closest_features/key_set.hpp"

namespace graze {

/// Which of the keys at the least distance are kept.
enum class Ties : std::uint8_t { lowest, all };

/// The keys at the least distance among some, and a bound on that distance.
struct Closest {
  KeySet keys;
  /// An upper bound of the least distance. It is infinite before the first offer. It may be known from
  /// elsewhere, before a key at that distance has been offered.
  double upper = std::numeric_limits<double>::infinity();
  /// Whether an edge pierces a face, among the keys offered.
  bool pierced = false;

  void clear() {
    keys.clear();
    upper = std::numeric_limits<double>::infinity();
    pierced = false;
  }
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.keys);
  }
};

/// Takes offers of keys. The bound only shrinks.
class ClosestSet {
 public:
  /// Continues from the content of `closest`.
  ClosestSet(const SurfacePair& pair, Ties ties, Closest& closest)
      : pair_(pair), ties_(ties), closest_(closest), keys_(closest.keys) {}

  void offer(const FeaturePairKey& offered) {
    const FeaturePairKey key = in_order(pair_, offered);
    closest_.pierced = closest_.pierced || is_edge_through_face(key);
    if (keys_.empty()) return replace(key);
    const bool is_known = ties_ == Ties::lowest ? key == keys_.front() : keys_.contains(key);
    if (is_known) return;
    pair_.check_time();
    const int order = compare_distances(pair_, key, keys_.front());
    if (order < 0) return replace(key);
    if (order > 0) return;
    if (ties_ == Ties::all)
      keys_.add(key);
    else if (key < keys_.front())
      keys_.assign(key);
  }
  /// Nothing further than this is nearest.
  void at_most(double distance) { closest_.upper = std::min(closest_.upper, distance); }
  /// Whether one key is enough, it is at distance 0, and that is contact.
  [[nodiscard]] bool is_decided(double threshold) const {
    return ties_ == Ties::lowest && closest_.upper == 0 && !keys_.empty() &&
           (closest_.pierced || threshold > 0);
  }
  /// Whether all keys at the least distance are kept.
  [[nodiscard]] bool wants_all() const { return ties_ == Ties::all; }
  /// Whether two vertices are probably among the keys: certainly not where none are.
  [[nodiscard]] bool has_vertices() const {
    return !keys_.empty() && keys_.front().kind() == ContactKind::VV;
  }
  /// Puts the keys in order.
  void merge_runs() { keys_.merge_runs(); }

  [[nodiscard]] double upper() const { return closest_.upper; }
  /// One of the keys. It is the lowest with Ties::lowest, or after `merge_runs`.
  [[nodiscard]] const FeaturePairKey& front() const { return keys_.front(); }

 private:
  void replace(const FeaturePairKey& key) {
    const double upper = upper_distance(pair_, key);
    // A search at distance 0 alone must not take up something further that it met on the way.
    if (closest_.upper == 0 && upper > 0) return;
    keys_.assign(key);
    at_most(upper);
  }

  const SurfacePair& pair_;
  Ties ties_;
  Closest& closest_;
  KeySet& keys_;
};

}  // namespace graze
