#pragma once

#include <cstdint>
#include <graze/settings.hpp>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "object_store.hpp"

namespace graze {

/// The thresholds of one pair.
struct PairThresholds {
  double threshold = 0;  ///< contact distance, or the paper's last epsilon, and both margins
  double reach = 0;      ///< max(range, threshold)
  std::span<const double> epsilon;
};

/// Which pairs are looked at, and how far. Stepping thread only, but for the const calls.
class PairFilter {
 public:
  explicit PairFilter(const SceneSettings& settings) : settings_(settings) {}

  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, PairRule rule);
  void set_ignored(const Object& a, const Object& b, bool ignored);
  /// Drops what is kept of the pairs of a removed object.
  void forget(const Object& object);

  /// Whether layers, masks, motion and `ignore` let the pair through.
  [[nodiscard]] bool allows(const Object& a, const Object& b) const;
  [[nodiscard]] PairThresholds thresholds(const Object& a, const Object& b) const;
  /// Changes with every rule.
  [[nodiscard]] std::uint64_t rules_version() const { return rules_version_; }
  /// The largest reach of any pair of objects without margins.
  [[nodiscard]] double largest_reach() const;

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  static Key key_of(std::uint64_t first, std::uint64_t second) { return std::minmax(first, second); }
  [[nodiscard]] std::span<const double> epsilon_of(const PairRule& rule) const;

  const SceneSettings& settings_;
  std::map<Key, PairRule> rules_;  ///< by kinds, the lower first
  std::uint64_t rules_version_ = 0;
  std::set<Key> ignored_;  ///< by serials, the lower first
};

}  // namespace graze
