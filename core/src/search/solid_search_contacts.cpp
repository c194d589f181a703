// The part of the search about solids that adds the contacts inside, and sets sides.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "core/base/growth_policy.hpp"
#include "measure/measure_batch.hpp"
#include "search/solid_search.hpp"
#include "solid/nearest_on_surface.hpp"

namespace graze {
namespace {

auto key_of(const Contact& contact) {
  return std::tie(contact.kind, contact.feature_a, contact.feature_b);
}

/// The order in which contacts of a limited answer are kept.
bool is_nearer(const Contact& left, const Contact& right) {
  return left.distance != right.distance ? left.distance < right.distance : key_of(left) < key_of(right);
}

}  // namespace

/// Adds a contact for each vertex inside that is further from the surface than the threshold. The others have
/// one already.
void SolidSearch::add_contacts_inside() {
  PairAnswer& answer = *pair_.answer;
  if (!has_some() || answer.cut) return;  // what a cut answer keeps is nearer
  list_keys_inside();
  resize_to_overwrite(scratch_.contacts, scratch_.keys.size());
  measure(worker_.pair, scratch_.keys, scratch_.contacts, worker_.scratch.measure);
  const std::size_t limit = pair_.query.contact_limit;
  if (limit > 0 && answer.contacts.size() + scratch_.contacts.size() > limit)
    keep_nearest(limit - answer.contacts.size());
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

void SolidSearch::keep_nearest(std::size_t most) {
  auto& contacts = scratch_.contacts;
  pair_.answer->cut = true;
  const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(contacts.begin(), end, contacts.end(), is_nearer);
  contacts.erase(end, contacts.end());
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& left, const Contact& right) { return key_of(left) < key_of(right); });
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
    const bool takes_added = left == 0 || key_of(all[left - 1]) < key_of(added[i - 1]);
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

}  // namespace graze
