#pragma once

#include <algorithm>
#include <cstdint>
#include <graze/settings.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "broad_phase/broad_phase.hpp"
#include "objects/filter_traits.hpp"
#include "objects/object.hpp"
#include "objects/object_summary.hpp"
#include "pairs/ignored_groups.hpp"
#include "pairs/ignored_objects.hpp"

namespace graze {

/// The thresholds of one pair.
struct PairThresholds {
  double threshold = 0;  ///< contact distance, or the paper's last epsilon, and both margins
  double reach = 0;      ///< max(range, threshold)
  std::span<const double> epsilon;
};

/// Decides which pairs are tested and up to which distance. Stepping thread only, except for the const
/// members.
class PairFilter final : public IgnoredPairs {
 public:
  explicit PairFilter(const SceneSettings& settings);

  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, PairRule rule);
  void set_ignored(Object& a, Object& b, bool ignored) {
    ++ignored_version_;
    ignored_.set(a, b, ignored, changed_);
  }
  /// Takes out or puts back faces of `group_a` of a against those of `group_b` of b.
  void set_ignored(const Object& a, std::uint8_t group_a, const Object& b, std::uint8_t group_b,
                   bool ignored) {
    ++ignored_version_;
    groups_.set(a, group_a, b, group_b, ignored, changed_);
  }
  /// Takes up other groups for the faces of an object, as those of another mesh.
  void regroup(const Object& object, const std::shared_ptr<const FaceGroups>& groups) {
    ++ignored_version_;
    groups_.regroup(object.serial, groups, changed_);
  }
  /// Forgets the ignored pairs and groups of a removed object.
  void forget(Object& object);

  // Of IgnoredPairs: as a whole, or all groups of their faces.
  [[nodiscard]] bool is_empty() const override { return ignored_.is_empty() && groups_.is_empty(); }
  [[nodiscard]] bool contains(const Serials& pair) const override {
    return ignored_.contains(pair) || (!groups_.is_empty() && groups_.ignores_all(pair.first, pair.second));
  }
  [[nodiscard]] std::optional<std::span<const Serials>> changed() const override { return changed_.all(); }
  /// Forgets what `changed` names.
  void forget_changed() { changed_.clear(); }
  /// The number of pairs of all objects that are ignored, and that no lasting filter takes out.
  [[nodiscard]] std::uint64_t ignored_count() const {
    return ignored_.counted() + (groups_.is_empty() ? 0 : groups_.counted_besides(ignored_));
  }

  /// Calls `visit(kind_a, kind_b, rule)` with every rule, and the lower kind first.
  template <typename Visit>
  void visit_rules(const Visit& visit) const {
    if (rule_of_.empty()) return;
    for (std::uint32_t kind_a = 0; kind_a < kind_count; ++kind_a)
      for (std::uint32_t kind_b = kind_a; kind_b < kind_count; ++kind_b)
        if (const std::size_t rule = rule_of_[index_of(kind_a, kind_b)]; rule > 0)
          visit(kind_a, kind_b, rules_[rule - 1]);
  }
  /// Calls `visit(serial_a, serial_b)` with every pair that is ignored, in no order.
  template <typename Visit>
  void visit_ignored(const Visit& visit) const {
    ignored_.visit([&](const PairSet::Pair& pair) { visit(pair.first, pair.second); });
  }

  [[nodiscard]] const IgnoredGroups& ignored_groups() const { return groups_; }

  [[nodiscard]] PairVerdict verdict(const ObjectSummary& a, const ObjectSummary& b) const;
  [[nodiscard]] PairThresholds thresholds(const ObjectSummary& a, const ObjectSummary& b) const;
  /// PairThresholds::reach.
  [[nodiscard]] double reach(const ObjectSummary& a, const ObjectSummary& b) const {
    const Distances& distances = distances_of(a.kind, b.kind);
    return std::max(distances.range, distances.contact + (a.margin + b.margin));
  }
  /// A number that changes with every rule.
  [[nodiscard]] std::uint64_t rules_version() const { return rules_version_; }
  /// The ignored groups of faces of a pair. The slot of a is the lower.
  [[nodiscard]] PairGroups groups(const ObjectSummary& a, const ObjectSummary& b) const {
    return groups_.is_empty() ? PairGroups() : groups_.of(a.serial, b.serial);
  }
  /// A number that changes with every rule, and with every pair or group that becomes ignored or watched.
  [[nodiscard]] std::uint64_t version() const { return rules_version_ + ignored_version_; }
  /// How near surfaces have to come on the way so that a sweep says when.
  [[nodiscard]] double swept_gap() const { return settings_.swept_gap; }
  [[nodiscard]] const BroadPhase::HalfReaches& half_reaches() const { return half_reaches_; }

  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The distances of a pair of kinds, without margins.
  struct Distances {
    double contact = 0;
    double range = 0;
    std::span<const double> epsilon;

    [[nodiscard]] double reach() const { return std::max(range, contact); }
  };
  [[nodiscard]] Distances distances_of(const PairRule& rule) const;
  [[nodiscard]] const Distances& distances_of(std::uint32_t kind_a, std::uint32_t kind_b) const {
    return distances_[rule_of_.empty() ? 0 : rule_of_[index_of(kind_a, kind_b)]];
  }
  static std::size_t index_of(std::uint32_t kind_a, std::uint32_t kind_b);
  void find_half_reach(std::uint32_t kind);

  const SceneSettings& settings_;
  std::vector<PairRule> rules_;
  std::vector<Distances> distances_;  ///< the scene's own, then one for each rule
  std::vector<std::uint16_t>
      rule_of_;  ///< into `distances_`, for each kind and kind. It is empty without rules
  std::uint64_t rules_version_ = 0;
  std::uint64_t ignored_version_ = 0;
  BroadPhase::HalfReaches half_reaches_{};
  IgnoredObjects ignored_;
  IgnoredGroups groups_;
  ChangedPairs changed_;
};

}  // namespace graze
