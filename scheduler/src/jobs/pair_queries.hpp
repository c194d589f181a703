#pragma once

#include <cstddef>
#include <graze/settings.hpp>
#include <optional>

#include "base/contact_limit.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/pair_query.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// Returns what says which features of a pair are looked at by their groups, or null if all are, or none. It
/// is in `room` if faces are hidden, and no groups of the pair were ever ignored.
[[nodiscard]] const FeatureFilter* groups_of(const PairJob& job, std::optional<FeatureFilter>& room);

/// Says what is asked about the pair of a job, by the settings and by how the pair has moved. Any thread may
/// call the const members while jobs run: they only read.
class PairQueries {
 public:
  PairQueries(const SceneSettings& settings, const ContactLimit& contacts)
      : settings_(settings), contacts_(contacts) {}

  /// Begins a step with so many pairs, those at rest included. They share the memory of fronts and the
  /// distances of regions.
  void begin(std::size_t pairs) { pair_count_ = pairs; }
  /// The query of a job, without limits of work and time. It refers to `filter` if faces of the pair are
  /// hidden, and no groups were ever ignored.
  [[nodiscard]] PairQuery of(const PairJob& job, std::optional<FeatureFilter>& filter) const;

 private:
  void set_limits(PairQuery& query) const;
  static void set_slacks(PairQuery& query, const PairJob& job);
  void set_solids(PairQuery& query, const PairJob& job) const;

  const SceneSettings& settings_;
  const ContactLimit& contacts_;
  std::size_t pair_count_ = 0;
};

}  // namespace graze
