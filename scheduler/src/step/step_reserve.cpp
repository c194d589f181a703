#include "step/step_reserve.hpp"

#include <algorithm>
#include <graze/settings_fields.hpp>

namespace graze {
namespace {

/// A reserved pair's list has room for this many pairs of features for each of its share of the contacts;
/// SceneCapacity states it.
constexpr std::size_t features_of_contact = 4;

PairMemoryRoom room_for(const SceneCapacity& capacity, ContactDetail detail) {
  const bool has_lists = lists_piercings(detail) || detail == ContactDetail::vertices;
  const std::size_t contacts = capacity.contacts / capacity.near_pairs + 1;
  return {leaf_pairs_of_front, has_lists ? features_of_contact * contacts : 0};
}

bool is_nothing(const SceneCapacity& capacity) {
  return capacity.objects == 0 && capacity.near_pairs == 0 && capacity.contacts == 0 &&
         capacity.reports == 0 && capacity.impacts == 0;
}

/// The larger of each two numbers.
SceneCapacity both(const SceneCapacity& left, const SceneCapacity& right) {
  SceneCapacity larger = left;
  for_each_field<SceneCapacity>(
      [&](const auto& field) { larger.*field.member = std::max(left.*field.member, right.*field.member); });
  return larger;
}

}  // namespace

void StepReserve::reserve(const SceneCapacity& capacity) {
  if (is_nothing(capacity)) return;
  content_.store.reserve(capacity.objects);
  reports_.reserve(capacity.reports,
                   {capacity.near_pairs, capacity.contacts,
                    capacity.near_pairs > 0 ? settings_.region_distances : 0, capacity.impacts});
  if (capacity.near_pairs > 0) reserve_for_pairs(capacity);
  content_.reserved = both(content_.reserved, capacity);
}

/// The store gives room to objects that come later.
void StepReserve::reserve_for_sweeps(const SceneCapacity& capacity) {
  ObjectStore& store = content_.store;
  const std::size_t objects = std::max(capacity.objects, store.objects().size());
  store.reserve_sweeps();
  pairs_.reserve_for_sweeps(objects);
  sweeps_.reserve(objects, capacity.near_pairs, capacity.impacts);
}

void StepReserve::reserve_for_pairs(const SceneCapacity& capacity) {
  ObjectStore& store = content_.store;
  is_for_pairs_ = true;
  if (capacity.impacts > 0) reserve_for_sweeps(capacity);
  pairs_.reserve(std::max(capacity.objects, store.objects().size()), capacity.near_pairs,
                 room_for(capacity, settings_.detail));
  refit_.reserve(capacity.near_pairs);
  jobs_.reserve(capacity.near_pairs, capacity.contacts);
  rows_.reserve(capacity.near_pairs);
  for (const auto& object : store.objects()) {
    if (object == nullptr) continue;  // removed in this step
    object->end_view();
    prepare_surface(object->surface_to_write(), object->settings);
    store.bytes().count(*object);
    prepare_copy(*object);
  }
}

void StepReserve::prepare_surface(Surface& surface, const ObjectSettings& settings) {
  if (settings.motion != Motion::deformable) surface.reserve_positions(true);
  refit_.prepare(surface);
  jobs_.reserve_for(surface.mesh(), settings.solid);
  sweeps_.reserve_for(surface.mesh());
  if (settings.solid && !is_about_vertices(settings_.detail)) pairs_.reserve_for_solids();
}

void StepReserve::prepare_copy(Object& object) {
  if (!object.bound) return;
  const bool is_viewed = wants_blocks(settings_.detail, settings_.accuracy.mode()) &&
                         settings_.region_distances == 0 && object.surface().can_view(object.bound->view);
  if (is_viewed) return;
  object.surface_to_write().reserve_positions(object.bound->view.is_double());
  content_.store.bytes().count(object);
}

}  // namespace graze
