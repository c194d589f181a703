#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "messages.hpp"

namespace graze::cluster {

/// Whether the rank of the higher number has a pair of objects of two ranks, by their numbers. About half of
/// the pairs between two ranks belong to either, and a pair changes its rank only with its objects.
[[nodiscard]] bool higher_rank_has(Number one, Number other);
/// The rank that has a pair of two objects, by their numbers and the ranks that own them.
[[nodiscard]] inline int rank_of_pair(Number one, int of_one, Number other, int of_other) {
  return higher_rank_has(one, other) ? std::max(of_one, of_other) : std::min(of_one, of_other);
}
/// PairPlace of an object in its own rank.
[[nodiscard]] PairPlace place_of_own(Number number);
/// PairPlace of an object of rank `of` that is a ghost in rank `here`.
[[nodiscard]] PairPlace place_of_ghost(Number number, int of, int here);

/// Whether an object of a rank's scene is a ghost.
[[nodiscard]] inline bool is_ghost(const Object& object) {
  return object.place.offers == 0;
}

/// A box of an object that the rank owns, in one step.
struct OwnBox {
  Number number = 0;
  Box needed;  ///< where its pairs may be near, on all of its way
  FilterTraits traits;
};

/// Finds the objects that have to be ghosts in other ranks. Neighbours tell each other the boxes of their
/// objects, and this class remembers which boxes each side knows.
class Borders {
 public:
  explicit Borders(int rank) : rank_(rank) {}

  /// Takes up the boxes of all objects that the rank owns, ascending by number.
  void begin_step(std::span<const OwnBox> boxes);
  /// The box of all boxes that others may have to know.
  [[nodiscard]] const Box& extent() const { return extent_; }

  /// Writes for a neighbour what has changed in what it has to know. `extent` is that rank's.
  void tell(int rank, const Box& extent, ByteBuffer& message);
  /// Reads what a neighbour tells.
  void hear(int rank, std::span<const std::byte> message);
  /// Forgets all that was told and heard of a rank that is no neighbour any more.
  void part_from(int rank) { neighbours_.erase(rank); }
  /// Forgets everything about objects that go to other ranks.
  void forget_all() {
    neighbours_.clear();
    loose_.clear();
  }

  /// The objects that must be ghosts in a neighbour, since it has their pairs with objects of its own.
  [[nodiscard]] const std::set<Number>& wanted_by(int rank);

 private:
  struct Loose {
    Box box;
    std::uint64_t version = 0;
    FilterTraits traits;
  };
  struct Neighbour {
    std::map<Number, std::uint64_t> told;  ///< the versions of boxes that it knows
    std::map<Number, Loose> heard;
    std::set<Number> wanted;
    bool has_changed = true;  ///< since `wanted` was found
  };
  void find_wanted(int rank, Neighbour& neighbour) const;

  int rank_;
  std::map<Number, Loose> loose_;
  std::uint64_t versions_ = 0;
  Box extent_;
  std::map<int, Neighbour> neighbours_;
};

}  // namespace graze::cluster
