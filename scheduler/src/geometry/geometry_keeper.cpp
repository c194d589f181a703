#include "geometry/geometry_keeper.hpp"

#include <algorithm>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {

KeptHandle<KeptGeometry> GeometryKeeper::keep() {
  const bool is_listed = listed_at_ == store_.arrivals_and_departures();
  if (!is_listed) list_asking();
  if (asking_.empty()) return {};
  to_copy_.clear();
  for (Asking& asking : asking_)
    if (is_outdated(asking)) to_copy_.push_back(&asking);
  if (is_listed && to_copy_.empty() && geometries_.has_last()) return geometries_.last();
  fill_copies();
  fill(geometries_.next());
  count_bytes();
  return geometries_.last();
}

/// Lists the objects that ask, with the copies of those that were listed before.
void GeometryKeeper::list_asking() {
  was_asking_.swap(asking_);
  asking_.clear();
  auto before = was_asking_.begin();
  for (const auto& object : store_.objects()) {
    if (!object->settings.queries) continue;
    while (before != was_asking_.end() && before->serial < object->serial) ++before;
    if (before != was_asking_.end() && before->serial == object->serial)
      asking_.push_back(std::move(*before));
    else
      asking_.push_back({object.get(), object->serial, 0, {}});
  }
  was_asking_.clear();
  order_.clear();
  listed_at_ = store_.arrivals_and_departures();
}

bool GeometryKeeper::is_outdated(const Asking& asking) {
  return asking.version != asking.object->surface().version() ||
         !asking.copies.has_last_of(asking.object->users_mesh);
}

void GeometryKeeper::fill_copies() {
  constexpr double nanoseconds_each_vertex = 8;  // to copy it, and to box its faces
  double nanoseconds = 0;
  // A geometry that nobody has holds copies that can be filled again.
  geometries_.clear_unused();
  for (Asking* const asking : to_copy_) {
    (void)asking->copies.next(asking->object->users_mesh);
    nanoseconds += nanoseconds_each_vertex * asking->object->mesh->vertex_count();
  }
  const auto copy = [&](unsigned /*worker*/, std::size_t item) {
    Asking& asking = *to_copy_[item];
    const AccessScope scope({AccessRight::read(), {}});
    const Surface& from = asking.object->surface();
    asking.copies.last()->surface.copy_refitted(from);
    asking.version = from.version();
  };
  tasks_.run(to_copy_.size(), copy, {nanoseconds});
}

void GeometryKeeper::fill(KeptGeometry& geometry) {
  for (const Asking& asking : asking_) {
    const Object& object = *asking.object;
    objects_.push_back({object.id, object.serial, object.settings.layer, object.settings.collides_with,
                        object.settings.solid, asking.copies.last(),
                        object.hides_some_faces() ? object.face_groups : nullptr});
  }
  order_boxes();
  geometry.fill(objects_, order_);
  objects_.clear();
}

/// Orders the objects by their boxes anew, if the set of objects has changed or they may have moved far.
void GeometryKeeper::order_boxes() {
  constexpr std::uint32_t most_fills = 16;
  if (!order_.empty() && fills_of_order_++ < most_fills) return;
  boxes_.clear();
  for (const KeptObject& object : objects_) boxes_.push_back(object.surface->surface.box());
  box_order_.make(boxes_, order_, tasks_);
  fills_of_order_ = 0;
}

void GeometryKeeper::count_bytes() {
  byte_count_ = bytes_of(asking_) + bytes_of(was_asking_) + bytes_of(to_copy_) + geometries_.byte_count() +
                bytes_of(objects_) + box_order_.byte_count() + bytes_of(boxes_) + bytes_of(order_);
  for (const Asking& asking : asking_)
    for (const auto& copy : asking.copies.all())
      byte_count_ += sizeof(KeptSurface) + copy->surface.byte_count();
}

}  // namespace graze
