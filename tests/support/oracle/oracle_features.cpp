#include "support/oracle/oracle_features.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "support/oracle/oracle_edges.hpp"

namespace graze::oracle {

namespace {

class Collector {
 public:
  Collector(const ExactShape& a, const ExactShape& b, const Limit& limit, const FacePairs& pairs)
      : a_(a), b_(b), limit_(limit), pairs_(pairs) {}

  ExactContacts collect() {
    pierce();
    vertices_against_faces();
    segments_against_segments();
    find_sunk_edges();
    return std::move(contacts_);
  }

 private:
  /// Adds a contact. If there is one of that name already, the closer stays. On a tie the earlier stays.
  void add(Feature a, Feature b, ExactContact contact) {
    if (!contact.pierced && !limit_.admits(contact.distance_squared)) return;
    const auto [place, is_new] = contacts_.try_emplace(name_of(a, b), contact);
    if (!is_new && contact.distance_squared < place->second.distance_squared)
      place->second = std::move(contact);
  }

  static Feature face_feature(std::uint32_t face) { return {FeatureKind::face, face}; }
  [[nodiscard]] static bool is_crease(const Segment& segment) { return segment.fold || segment.folded_over; }

  void pierce() {
    for (const Segment& segment : a_.segments) {
      for (std::uint32_t face = 0; face < b_.faces.size(); ++face) {
        if (!pairs_.may_pierce(segment.owner, face_feature(face))) continue;
        if (const auto t = passes(a_, segment, b_, face)) {
          const Point point = point_at(a_, segment, *t);
          add(segment.owner, {FeatureKind::face, face}, {0, point, point, segment.is_edge()});
        }
      }
    }
    for (const Segment& segment : b_.segments) {
      for (std::uint32_t face = 0; face < a_.faces.size(); ++face) {
        if (!pairs_.may_pierce(face_feature(face), segment.owner)) continue;
        if (const auto t = passes(b_, segment, a_, face)) {
          const Point point = point_at(b_, segment, *t);
          add({FeatureKind::face, face}, segment.owner, {0, point, point, segment.is_edge()});
        }
      }
    }
  }

  [[nodiscard]] std::optional<Rational> passes(const ExactShape& shape, const Segment& segment,
                                               const ExactShape& other, std::uint32_t face) const {
    if (!segment.is_edge() && !is_crease(segment)) return std::nullopt;
    if (gap_squared(segment.extent, other.faces[face].extent) > 0) return std::nullopt;
    return crossing(shape, segment, other, face);
  }

  void vertices_against_faces() {
    for (const std::uint32_t vertex : a_.used) {
      for (std::uint32_t face = 0; face < b_.faces.size(); ++face) {
        if (!pairs_.may({FeatureKind::vertex, vertex}, face_feature(face))) continue;
        if (limit_.certainly_excludes(a_.point_extents[vertex], b_.faces[face].extent)) continue;
        const Foot foot = foot_on_face(a_.points[vertex], b_, face);
        add({FeatureKind::vertex, vertex}, foot.feature,
            {foot.distance_squared, a_.points[vertex], foot.point, false});
      }
    }
    for (const std::uint32_t vertex : b_.used) {
      for (std::uint32_t face = 0; face < a_.faces.size(); ++face) {
        if (!pairs_.may(face_feature(face), {FeatureKind::vertex, vertex})) continue;
        if (limit_.certainly_excludes(b_.point_extents[vertex], a_.faces[face].extent)) continue;
        const Foot foot = foot_on_face(b_.points[vertex], a_, face);
        add(foot.feature, {FeatureKind::vertex, vertex},
            {foot.distance_squared, foot.point, b_.points[vertex], false});
      }
    }
  }

  void segments_against_segments() {
    for (const Segment& segment_a : a_.segments) {
      for (const Segment& segment_b : b_.segments) {
        if (pairs_.may(segment_a.owner, segment_b.owner) &&
            !limit_.certainly_excludes(segment_a.extent, segment_b.extent))
          add_segments(segment_a, segment_b);
      }
    }
  }

  void add_segments(const Segment& segment_a, const Segment& segment_b) {
    const bool edges = segment_a.is_edge() && segment_b.is_edge();
    if (!segment_a.is_edge() && !is_crease(segment_a)) return;
    if (!segment_b.is_edge() && !is_crease(segment_b)) return;
    if (const auto inner = inner_contact(a_, segment_a, b_, segment_b)) {
      add_contact(*inner);
    } else if (edges) {
      for (const SegmentContact& contact : end_contacts(a_, segment_a, b_, segment_b)) add_contact(contact);
    }
  }

  void find_sunk_edges() {
    const auto is_of_edges = [](const auto& entry) { return entry.first.kind == ContactKind::EE; };
    if (std::none_of(contacts_.begin(), contacts_.end(), is_of_edges)) return;
    const EdgeOracle edges(a_, b_, pairs_);
    for (auto& [name, contact] : contacts_)
      contact.sunk = name.kind == ContactKind::EE && edges.are_sunk(name.a, name.b);
  }

  void add_contact(const SegmentContact& contact) {
    add(contact.a.feature, contact.b.feature,
        {contact.a.distance_squared, contact.a.point, contact.b.point, false});
  }

  const ExactShape& a_;
  const ExactShape& b_;
  const Limit& limit_;
  const FacePairs& pairs_;
  ExactContacts contacts_;
};

}  // namespace

Name name_of(Feature a, Feature b) {
  using enum ContactKind;
  static constexpr std::array<std::array<ContactKind, 3>, 3> kinds = {
      {{VV, VE, VF}, {VE, EE, EF}, {VF, EF, FF}}};
  return {kinds[static_cast<std::size_t>(a.kind)][static_cast<std::size_t>(b.kind)], a, b};
}

ExactContacts collect_features(const ExactShape& a, const ExactShape& b, const Limit& limit,
                               const FacePairs& pairs) {
  return Collector(a, b, limit, pairs).collect();
}

Named rounded(const Name& name, const ExactContact& contact) {
  return {name.kind,
          name.a,
          name.b,
          round_sqrt(contact.distance_squared),
          contact.distance_squared,
          round(contact.point_a),
          round(contact.point_b),
          contact.pierced,
          contact.sunk};
}

std::vector<Named> rounded(const ExactContacts& contacts) {
  std::vector<Named> result;
  result.reserve(contacts.size());
  for (const auto& [name, contact] : contacts) result.push_back(rounded(name, contact));
  return result;
}

std::vector<Named> features(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs) {
  return rounded(collect_features(ExactShape(a), ExactShape(b), Limit::below(threshold), pairs));
}

}  // namespace graze::oracle
