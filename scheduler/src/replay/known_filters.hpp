#pragma once

#include <graze/pair_filters.hpp>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "calls/calls.hpp"

namespace graze {

/// What calls have said of pairs, of objects that are there.
class KnownFilters {
 public:
  void take(const IgnorePair& call);
  void take(const IgnoreGroups& call);
  void take(const SetRule& call);
  /// Forgets what was said of an object.
  void forget(ObjectId object);
  /// All of it. This is another object after calls that said something new, and else the same one.
  [[nodiscard]] std::shared_ptr<const PairFilters> all();

 private:
  using FaceGroup = PairFilters::FaceGroup;

  std::set<std::pair<ObjectId, ObjectId>> ignored_;
  std::set<std::pair<FaceGroup, FaceGroup>> ignored_groups_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRule> rules_;  ///< by kinds, the lower first
  std::shared_ptr<const PairFilters> all_;                             ///< none after a call
};

}  // namespace graze
