#include "geometry/mesh_keeper.hpp"

#include <utility>

namespace graze {

KeptHandle<KeptMeshes> MeshKeeper::keep() {
  const std::uint64_t departures = store_.arrivals_and_departures();
  lists_.clear_unused();
  if (lists_.has_last() && seen_departures_ == departures && !store_.some_replaced()) return lists_.last();
  // The last list stays in its handle until the new one has what it needs of it.
  const KeptHandle<KeptMeshes> last = lists_.has_last() ? lists_.last() : KeptHandle<KeptMeshes>();
  KeptMeshes& now = lists_.next();
  if (last.get() != nullptr) now.begin_with(*last.get());
  for (const DepartedObject& departed : store_.departed()) now.set(departed.id, nullptr);
  store_.visit_arrived(seen_arrival_, [&](const Object& object) { now.set(object.id, object.users_mesh); });
  if (store_.some_replaced())
    for (const Object* const object : store_.replaced()) now.set(object->id, object->users_mesh);
  seen_arrival_ = store_.next_arrival();
  seen_departures_ = departures;
  byte_count_ = lists_.byte_count() + now.byte_count_of_parts();
  return lists_.last();
}

}  // namespace graze
