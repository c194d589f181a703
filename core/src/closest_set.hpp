#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "contact_name.hpp"

namespace graze {

/// Which of the names at the least distance are kept.
enum class Ties : std::uint8_t { lowest, all };

/// The names at the least distance among those offered, and a bound on that distance that only shrinks.
class ClosestSet {
 public:
  ClosestSet(const SurfacePair& pair, Ties ties, std::vector<ContactName>& names)
      : pair_(pair), ties_(ties), names_(names) {
    names_.clear();
  }

  void offer(const ContactName& name) {
    if (name.meeting == Meeting::pierced) pierced_ = pierced_ || is_edge_through_face(name);
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

  /// At least the least distance; infinite before the first offer.
  [[nodiscard]] double upper() const { return upper_; }
  /// Whether an edge pierces a face, among the names offered.
  [[nodiscard]] bool pierced() const { return pierced_; }
  [[nodiscard]] const std::vector<ContactName>& names() const { return names_; }

 private:
  static bool is_edge_through_face(const ContactName& name) { return name.kind == ContactKind::EF; }
  void replace(const ContactName& name) {
    names_.assign(1, name);
    upper_ = upper_distance(pair_, name);
  }

  const SurfacePair& pair_;
  Ties ties_;
  std::vector<ContactName>& names_;
  double upper_ = std::numeric_limits<double>::infinity();
  bool pierced_ = false;
};

}  // namespace graze
