#include "support/oracle/oracle_grouped_nearest.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "support/exact/exact_distance.hpp"
#include "support/oracle/oracle_edges.hpp"
#include "support/oracle/oracle_features.hpp"

namespace graze::oracle {
namespace {

class NearestContacts {
 public:
  NearestContacts(const Shape& a, const Shape& b, double threshold, const Creases& creases,
                  const FacePairs& pairs)
      : a_(a), b_(b), limit_(Limit::below(threshold)), pairs_(pairs) {
    add_vertices();
    add_edges(creases);
    for (const auto& [name, contact] : collect_features(a_, b_, Limit::below(0), pairs))
      if (contact.pierced) contacts_.try_emplace(name, contact);
  }
  [[nodiscard]] std::vector<Named> all() const { return rounded(contacts_); }

 private:
  static Feature face_feature(std::uint32_t face) { return {FeatureKind::face, face}; }

  /// The closest point on the faces for which `may(face)` holds.
  template <typename May>
  [[nodiscard]] std::optional<Foot> foot_of(const Point& point, const ExactShape& other,
                                            const May& may) const {
    std::optional<Foot> best;
    for (std::uint32_t face = 0; face < other.faces.size(); ++face) {
      if (!may(face_feature(face))) continue;
      Foot foot = foot_on_face(point, other, face);
      if (!limit_.admits(foot.distance_squared)) continue;
      const int order = best ? cmp(foot.distance_squared, best->distance_squared) : -1;
      if (order < 0 || (order == 0 && foot.feature < best->feature)) best = std::move(foot);
    }
    return best;
  }
  void add_vertices() {
    for (const std::uint32_t vertex : a_.used) {
      const Feature of_a{FeatureKind::vertex, vertex};
      if (const auto foot =
              foot_of(a_.points[vertex], b_, [&](const Feature& face) { return pairs_.may(of_a, face); }))
        contacts_.try_emplace(name_of(of_a, foot->feature),
                              ExactContact{foot->distance_squared, a_.points[vertex], foot->point});
    }
    for (const std::uint32_t vertex : b_.used) {
      const Feature of_b{FeatureKind::vertex, vertex};
      if (const auto foot =
              foot_of(b_.points[vertex], a_, [&](const Feature& face) { return pairs_.may(face, of_b); }))
        contacts_.try_emplace(name_of(foot->feature, of_b),
                              ExactContact{foot->distance_squared, foot->point, b_.points[vertex]});
    }
  }

  void add_edges(const Creases& creases) {
    for (const EdgePair& pair : EdgeOracle(a_, b_, pairs_).pairs_within(limit_, creases))
      if (pair.is_listed())
        contacts_.try_emplace(name_of(pair.a, pair.b),
                              ExactContact{pair.contact.a.distance_squared, pair.contact.a.point,
                                           pair.contact.b.point, false, pair.is_sunk});
  }

  ExactShape a_;
  ExactShape b_;
  Limit limit_;
  const FacePairs& pairs_;
  ExactContacts contacts_;
};

}  // namespace

std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold, const Shape& rest_a,
                           const Shape& rest_b, const FacePairs& pairs) {
  return NearestContacts(a, b, threshold, Creases(rest_a, rest_b), pairs).all();
}

}  // namespace graze::oracle
