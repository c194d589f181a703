#pragma once

#include <algorithm>
#include <graze/pair_query.hpp>
#include <limits>
#include <vector>

#include "contact_name.hpp"
#include "reserve_as.hpp"

namespace graze {

/// Which of the names at the least distance are kept.
enum class Ties : std::uint8_t { lowest, all };

/// The names at the least distance among some, and a bound on that distance.
struct Closest {
  std::vector<ContactName> names;
  /// At least the least distance; infinite before the first offer.
  double upper = std::numeric_limits<double>::infinity();
  /// Whether an edge pierces a face, among the names offered.
  bool pierced = false;

  void clear() {
    names.clear();
    upper = std::numeric_limits<double>::infinity();
    pierced = false;
  }
  void reserve_as(const Closest& other) { graze::reserve_as(names, other.names); }
  void reserve(const PairRoom& room) { names.reserve(room.ties); }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(names); }
};

/// Takes offers of names; the bound only shrinks.
class ClosestSet {
 public:
  /// Goes on from what is in `closest`.
  ClosestSet(const SurfacePair& pair, Ties ties, Closest& closest)
      : pair_(pair), ties_(ties), closest_(closest), names_(closest.names) {}

  void offer(const ContactName& name) {
    if (name.meeting == Meeting::pierced) closest_.pierced = closest_.pierced || is_edge_through_face(name);
    if (names_.empty()) return replace(name);
    if (ties_ == Ties::lowest && name == names_.front()) return;
    const auto place = std::lower_bound(names_.begin(), names_.end(), name);
    if (ties_ == Ties::all && place != names_.end() && *place == name) return;
    const int order = compare_distances(pair_, name, names_.front());
    if (order < 0) return replace(name);
    if (order > 0) return;
    if (ties_ == Ties::all)
      names_.insert(place, name);
    else if (name < names_.front())
      names_.front() = name;
  }

  [[nodiscard]] double upper() const { return closest_.upper; }
  [[nodiscard]] const std::vector<ContactName>& names() const { return names_; }

 private:
  static bool is_edge_through_face(const ContactName& name) { return name.kind == ContactKind::EF; }
  void replace(const ContactName& name) {
    names_.assign(1, name);
    closest_.upper = upper_distance(pair_, name);
  }

  const SurfacePair& pair_;
  Ties ties_;
  Closest& closest_;
  std::vector<ContactName>& names_;
};

}  // namespace graze
