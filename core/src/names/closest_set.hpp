#pragma once

#include <algorithm>
#include <limits>

#include "names/contact_name.hpp"
#include "names/name_set.hpp"

namespace graze {

/// Which of the names at the least distance are kept.
enum class Ties : std::uint8_t { lowest, all };

/// Whether an edge pierces a face, which is contact at every threshold; a fold that does is no edge.
inline bool is_edge_through_face(const ContactName& name) {
  return name.meeting() == Meeting::pierced && name.kind() == ContactKind::EF;
}

/// The names at the least distance among some, and a bound on that distance.
struct Closest {
  NameSet names;
  /// At least the least distance that is looked for; infinite before the first offer. It may be known from
  /// elsewhere, before a name at that distance has been offered.
  double upper = std::numeric_limits<double>::infinity();
  /// Whether an edge pierces a face, among the names offered.
  bool pierced = false;

  void clear() {
    names.clear();
    upper = std::numeric_limits<double>::infinity();
    pierced = false;
  }
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.names);
  }
};

/// Takes offers of names; the bound only shrinks.
class ClosestSet {
 public:
  /// Goes on from what is in `closest`.
  ClosestSet(const SurfacePair& pair, Ties ties, Closest& closest)
      : pair_(pair), ties_(ties), closest_(closest), names_(closest.names) {}

  void offer(const ContactName& name) {
    closest_.pierced = closest_.pierced || is_edge_through_face(name);
    if (names_.empty()) return replace(name);
    const bool is_known = ties_ == Ties::lowest ? name == names_.front() : names_.contains(name);
    if (is_known) return;
    pair_.check_time();
    const int order = compare_distances(pair_, name, names_.front());
    if (order < 0) return replace(name);
    if (order > 0) return;
    if (ties_ == Ties::all)
      names_.add(name);
    else if (name < names_.front())
      names_.assign(name);
  }
  /// Nothing further than this is nearest.
  void at_most(double distance) { closest_.upper = std::min(closest_.upper, distance); }
  /// Whether one name is enough, it is at distance 0, and that is contact.
  [[nodiscard]] bool is_settled(double threshold) const {
    return ties_ == Ties::lowest && closest_.upper == 0 && !names_.empty() &&
           (closest_.pierced || threshold > 0);
  }
  /// Puts the names in order.
  void settle() { names_.settle(); }

  [[nodiscard]] double upper() const { return closest_.upper; }
  /// One of them; with Ties::lowest, or once they are settled, the lowest.
  [[nodiscard]] const ContactName& front() const { return names_.front(); }

 private:
  void replace(const ContactName& name) {
    const double upper = upper_distance(pair_, name);
    // What is looked for at 0 alone is not found in what a look that went further met.
    if (closest_.upper == 0 && upper > 0) return;
    names_.assign(name);
    at_most(upper);
  }

  const SurfacePair& pair_;
  Ties ties_;
  Closest& closest_;
  NameSet& names_;
};

}  // namespace graze
