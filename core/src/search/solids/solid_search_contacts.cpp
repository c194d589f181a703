// The part of the search about solids that adds the contacts inside, and sets sides.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "closest_features/piercing.hpp"
#include "core/base/growth_policy.hpp"
#include "core/pair/contact_rank.hpp"
#include "measure/measure_batch.hpp"
#include "search/solids/solid_search.hpp"
#include "solid/nearest_on_surface.hpp"
#include "solid/point_in_solid.hpp"

namespace graze {

/// Adds a contact for each vertex inside that is further from the surface than the threshold. The others have
/// one already.
void SolidSearch::add_contacts_inside() {
  if (!has_some()) return;
  list_keys_inside();
  resize_to_overwrite(scratch_.contacts, scratch_.keys.size());
  measure(worker_.pair, scratch_.keys, scratch_.contacts, worker_.scratch.measure);
  merge_contacts();
}

/// Lists the keys of vertices inside, those of contacts left out, in their order and each once.
void SolidSearch::list_keys_inside() {
  scratch_.keys.clear();
  const auto add_all = [&](bool are_of_a, std::span<const std::uint32_t> vertices) {
    if (vertices.empty()) return;
    NearestOnSurface nearest(worker_.pair, are_of_a, worker_.scratch.features);
    constexpr std::size_t some = 16;  // about a leaf
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i % some == 0) nearest.begin_some(vertices.subspan(i, std::min(some, vertices.size() - i)));
      const std::optional<VertexNearest> found = nearest.find(vertices[i]);
      if (found && !is_closer_than(worker_.pair, found->key, found->squared, pair_.query.threshold))
        scratch_.keys.push_back(found->key);
    }
  };
  add_all(true, scratch_.a_in_b.inside());
  add_all(false, scratch_.b_in_a.inside());
  std::sort(scratch_.keys.begin(), scratch_.keys.end());
  scratch_.keys.erase(std::unique(scratch_.keys.begin(), scratch_.keys.end()), scratch_.keys.end());
}

/// Merges the contacts inside into the answer's, from the back, in place.
void SolidSearch::merge_contacts() {
  auto& all = pair_.answer->contacts;
  auto& added = scratch_.contacts;
  std::size_t left = all.size();
  std::size_t to = left + added.size();
  if (all.capacity() < to) all.reserve(with_growth_room(to));
  all.resize(to);
  for (std::size_t i = added.size(); i > 0;) {
    const bool takes_added = left == 0 || contact_order(all[left - 1]) < contact_order(added[i - 1]);
    all[--to] = takes_added ? added[--i] : all[--left];
  }
}

void SolidSearch::set_sides() const {
  for (Contact& contact : pair_.answer->contacts) {
    if (pair_.query.a_is_solid && contact.feature_b.kind == FeatureKind::vertex)
      contact.side_a = scratch_.b_in_a.side_of(contact.feature_b.index);
    if (pair_.query.b_is_solid && contact.feature_a.kind == FeatureKind::vertex)
      contact.side_b = scratch_.a_in_b.side_of(contact.feature_a.index);
  }
}

/// Marks the contacts of edges that pierce a solid's face whose normal leads into the solid.
void SolidSearch::turn_pushes() const {
  for (Contact& contact : pair_.answer->contacts) {
    if (contact.kind != ContactKind::EF || contact.distance != 0) continue;
    const bool is_face_of_a = contact.feature_a.kind == FeatureKind::face;
    const bool is_of_solid = is_face_of_a ? pair_.query.a_is_solid : pair_.query.b_is_solid;
    if (is_of_solid && leads_in(contact)) (is_face_of_a ? contact.side_a : contact.side_b) = Side::back;
  }
}

/// Whether the normal of a pierced face leads into its solid. That takes a ray, which most edges need not:
/// one with an end inside, and the other outside and in front of the face, leads in where nothing is inside
/// out.
bool SolidSearch::leads_in(const Contact& contact) const {
  const bool is_face_of_a = contact.feature_a.kind == FeatureKind::face;
  const Surface& solid = is_face_of_a ? *pair_.a : *pair_.b;
  const Surface& other = is_face_of_a ? *pair_.b : *pair_.a;
  const Feature& face = is_face_of_a ? contact.feature_a : contact.feature_b;
  const Feature& edge = is_face_of_a ? contact.feature_b : contact.feature_a;
  const VerticesInSolid& vertices = is_face_of_a ? scratch_.b_in_a : scratch_.a_in_b;
  const auto [first, second] = other.mesh().edge(edge.index);
  // The normal of the contact is that of a's face, or the opposite of b's.
  const double way = contact.normal.dot(other.position(second) - other.position(first));
  const bool is_second_in_front = (way > 0) == is_face_of_a;
  const Side in_front = vertices.side_of(is_second_in_front ? second : first);
  const Side behind = vertices.side_of(is_second_in_front ? first : second);
  if (!vertices.has_inside_out() && in_front == Side::front && behind == Side::back) return false;
  const auto pierced = pierced_piece(other, edge_piece(edge.index), solid, face.index, worker_.pair.count);
  return pierced && normal_leads_in(solid, *pierced, contact.point_a, worker_.pair.count);
}

}  // namespace graze
