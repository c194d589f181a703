#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "core/pair/group_filter.hpp"
#include "objects/filter_traits.hpp"
#include "objects/object.hpp"
#include "pairs/ignored_objects.hpp"

namespace graze {

/// The groups of faces of one pair that are not tested against each other.
struct PairGroups {
  /// The filter that its searches use, which knows hidden faces too. Null where all features are tested,
  /// or none, or where no groups were ever ignored.
  const GroupFilter* filter = nullptr;
  /// A number that changes whenever the filter may have. 0 for a pair of which no groups were ever ignored.
  std::uint64_t version = 0;
};

/// The groups of faces that Scene::ignore() took out, for each pair of objects. A pair stays known until one
/// of its objects is removed, so that a call about known groups takes no memory. Stepping thread only, except
/// for the const members.
class IgnoredGroups {
 public:
  /// Takes two groups out or puts them back. `a` and `b` may be one object. Names the pair in `changed`, if
  /// it may make a difference to `ignores_all`.
  void set(const Object& a, std::uint8_t group_a, const Object& b, std::uint8_t group_b, bool ignored,
           ChangedPairs& changed);
  /// Takes up other groups for the faces of an object, as those of another mesh. What is ignored stays.
  void regroup(std::uint64_t serial, const std::shared_ptr<const FaceGroups>& groups, ChangedPairs& changed);
  /// Forgets the pairs of a removed object.
  void forget(std::uint64_t serial);

  [[nodiscard]] bool is_empty() const { return pairs_.empty(); }
  /// Whether all faces of the one are ignored against all of the other. The lower serial comes first, here
  /// and below.
  [[nodiscard]] bool ignores_all(std::uint64_t serial_a, std::uint64_t serial_b) const;
  [[nodiscard]] PairGroups of(std::uint64_t serial_a, std::uint64_t serial_b) const;
  /// The number of pairs of which all is ignored, which no lasting filter takes out, and which are not in
  /// `whole`.
  [[nodiscard]] std::uint64_t counted_besides(const IgnoredObjects& whole) const;
  /// Calls `visit(serial_a, group_a, serial_b, group_b)` with all groups that are ignored, ascending. A pair
  /// of groups of one object comes once.
  template <typename Visit>
  void visit(const Visit& visit) const {
    for (const auto& [serials, known] : pairs_) {
      const std::uint64_t a = serials.first;
      const std::uint64_t b = serials.second;
      known.filter.visit_ignored([&visit, a, b](std::uint8_t group_a, std::uint8_t group_b) {
        if (a != b || group_a <= group_b) visit(a, group_a, b, group_b);
      });
    }
  }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  using Serials = std::pair<std::uint64_t, std::uint64_t>;
  struct Known {
    GroupFilter filter;
    bool counts = false;  ///< no lasting filter takes the pair out, and it is of two objects
    std::uint64_t version = 0;
  };

  std::map<Serials, Known> pairs_;  ///< a map, since jobs refer to its filters
  std::uint64_t version_ = 0;       ///< of the last change
};

}  // namespace graze
