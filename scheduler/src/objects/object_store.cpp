#include "objects/object_store.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <span>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "objects/object_reading.hpp"

namespace graze {
namespace {

/// Reserves memory for one more element, so that adding it does not throw.
template <typename Element>
void make_room_for_one(std::vector<Element>& elements) {
  if (elements.size() == elements.capacity()) elements.reserve(2 * elements.size() + 1);
}

/// Frees a removed object's copy, which no object can use again.
void discard(SparePositions::Loan& positions) {
  if (positions == nullptr) return;
  positions.get_deleter().is_last = true;
  positions.reset();
}

/// Gives an object a surface at rest that no step has seen.
void put_surface(Object& object, std::unique_ptr<Surface> surface) {
  object.owned_surface = std::move(surface);
  object.box = object.seen.box = object.surface().box();
  object.version = object.surface().version();
  object.mesh = &object.surface().mesh();
  object.in_parts = object.mesh->vertex_count() > vertices_of_part;
}

/// Maps the vertices of the mesh that the last report speaks of through another replacement.
void compose(std::vector<std::uint32_t>& new_of_old, std::span<const std::uint32_t> next) {
  for (std::uint32_t& vertex : new_of_old)
    if (vertex != Mesh::no_vertex) vertex = next[vertex];
}

}  // namespace

Object* ObjectStore::find(ObjectId id) const {
  if (id.index >= by_index_.size() || by_index_[id.index] == nullptr) return nullptr;
  Object* const object = by_index_[id.index];
  return object->id == id ? object : nullptr;
}

const Object* ObjectStore::find_serial(std::uint64_t serial) const {
  const auto found = std::lower_bound(serials_.begin(), serials_.end(), serial);
  if (found == serials_.end() || *found != serial) return nullptr;
  return objects_[static_cast<std::size_t>(found - serials_.begin())].get();
}

/// Takes up the settings of an object that is added. Objects that may be in swept pairs from now on are read
/// in the next step if they are unread.
bool ObjectStore::take_up_sweep(const ObjectSettings& settings) {
  if (!swept_.take_up(settings)) return false;
  for (const auto& object : objects_) {
    if (object == nullptr || object->sweep != nullptr || !swept_.may_meet(object->settings)) continue;
    make_sweep(*object, *object->mesh);
    if (object->is_unread()) reads_.expect(*object);
  }
  return true;
}

void ObjectStore::make_sweep(Object& object, const IndexedMesh& mesh) const {
  auto sweep = std::make_unique<ObjectSweep>();
  if (sweeps_are_reserved_) sweep->motion.reserve(mesh);
  object.sweep = std::move(sweep);
}

void ObjectStore::apply(AddObject& call) {
  take_up_sweep(call.settings);
  auto object = std::make_unique<Object>();
  if (swept_.some() && swept_.may_meet(call.settings)) make_sweep(*object, call.surface->mesh());
  const std::uint64_t serial = call.serial.value_or(next_serial_);
  const bool is_inserted = serial < next_serial_;
  make_room_for_one(serials_);
  make_room_for_one(is_inserted ? inserted_ : objects_);
  if (by_index_.size() <= call.object.index) by_index_.resize(call.object.index + std::size_t{1}, nullptr);
  // From here on nothing throws.
  object->id = call.object;
  object->serial = serial;
  object->arrival = next_arrival_++;
  object->place = call.place;
  object->settings = std::move(call.settings);
  object->face_groups = std::move(call.face_groups);
  object->self = std::move(call.self);
  object->users_mesh = std::move(call.mesh);
  put_surface(*object, std::move(call.surface));
  bytes_.count(*object);
  by_index_[call.object.index] = object.get();
  will_have_changed_ = true;
  if (is_inserted) {
    ++insertions_;
    return inserted_.push_back(std::move(object));
  }
  next_serial_ = serial + 1;
  serials_.push_back(serial);
  objects_.push_back(std::move(object));
}

/// The object is what an added one would be. But a posed one keeps its pose, or waits for a good one still.
void ObjectStore::apply(ReplaceMesh& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  reads_.make_room_for_one();
  make_room_for_one(replaced_);
  if (sweeps_are_reserved_ && object->sweep != nullptr) object->sweep->motion.reserve(call.surface->mesh());
  auto replaced =
      object->replaced != nullptr ? std::move(object->replaced) : std::make_unique<ReplacedMesh>();
  // From here on nothing throws.
  if (replaced->mesh != nullptr) {
    compose(replaced->new_of_old, call.new_of_old);
  } else {
    *replaced = {object->surface().shared_mesh(), std::move(call.new_of_old)};
    replaced_.push_back(object);
  }
  const bool was_in_parts = object->in_parts;
  Object now;
  now.id = object->id;
  now.serial = object->serial;
  now.arrival = object->arrival;
  now.place = object->place;
  now.settings = std::move(object->settings);
  now.settings.face_groups = std::move(call.group_of_face);
  now.face_groups = std::move(call.face_groups);
  now.self = std::move(call.self);
  now.users_mesh = std::move(call.mesh);
  now.mesh_number = object->mesh_number + 1;
  now.replaced = std::move(replaced);
  now.ignored_partners = std::move(object->ignored_partners);
  now.sweep = std::move(object->sweep);
  if (now.sweep != nullptr) now.sweep->kept_step = 0;  // it stands in the next step
  now.frozen = object->frozen && object->is_posed();
  if (!now.frozen) now.pose = object->pose ? object->pose : object->standing_pose;
  now.may_have_input = object->may_have_input;
  now.counted_bytes = object->counted_bytes;
  call.surface->succeed(object->surface());
  put_surface(now, std::move(call.surface));
  *object = std::move(now);
  if (object->in_parts != was_in_parts) reads_.sort_in(*object);
  bytes_.count(*object);
  if (object->pose) reads_.expect(*object);
  will_have_changed_ = true;
}

void ObjectStore::forget_replaced() noexcept {
  for (Object* const object : replaced_) object->replaced.reset();
  replaced_.clear();
}

void ObjectStore::apply(const RemoveObject& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  make_room_for_one(removed_);
  make_room_for_one(departed_);
  sort_in_inserted();
  by_index_[call.object.index] = nullptr;
  bytes_.leave_out(*object);
  object->removed = true;
  const auto slot = std::lower_bound(serials_.begin(), serials_.end(), object->serial) - serials_.begin();
  departed_.push_back({object->id, object->serial});
  removed_.push_back(std::move(objects_[static_cast<std::size_t>(slot)]));
  will_have_changed_ = true;
}

void ObjectStore::apply(const SetPose& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  if (std::exchange(object->frozen, false)) will_have_changed_ = true;
  // The object already has this pose, or a survey has used it. Poses are compared by their bits.
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  if (object->standing_pose && std::memcmp(&*object->standing_pose, &call.rows, sizeof(Pose)) == 0) {
    object->pose.reset();
  } else {
    reads_.expect(*object);
    object->pose = call.rows;
  }
}

/// A good pose that came earlier in the same step is not accepted either.
void ObjectStore::apply(const RefusePose& call) noexcept {
  Object* const object = find(call.problem.object);
  if (object == nullptr) return;
  object->pose.reset();
  if (!std::exchange(object->frozen, true)) will_have_changed_ = true;
}

void ObjectStore::apply(const SettlePose& call) {
  Object* const object = find(call.object);
  if (object == nullptr || !is_new(*object) || !object->is_posed()) return;
  object->is_settled = true;
  if (!object->pose) return;
  settle_pose(*object);
  bytes_.count(*object);
}

void ObjectStore::apply(SetPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr || is_outdated(call)) return;
  reads_.expect(*object, std::isinf(call.max_displacement));
  object->bound.reset();
  object->positions = std::move(call.positions);
  object->box_of_positions = call.box;
  object->promises.next = call.max_displacement;
}

void ObjectStore::apply(const BindPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  reads_.expect(*object);
  object->positions.reset();
  object->bound = BoundMemory{call.view, call.policy};
  object->is_unobserved = true;
  object->moved = true;  // it may be anywhere
  object->promises.next = Promises::any_distance;
  object->promises.are_made = false;
}

bool ObjectStore::is_outdated(const SetPositions& call) const {
  const Object* const object = find(call.object);
  return object != nullptr && object->mesh_number != call.mesh_number;
}

bool ObjectStore::wants(const UnbindPositions& call) const {
  const Object* const object = find(call.object);
  if (call.is_due || object == nullptr || !object->bound) return call.is_due;
  // Positions that were only surveyed, or told of since the last step, have not been read yet.
  return object->is_surveyed() || object->bound->is_notified;
}

void ObjectStore::apply(UnbindPositions& call, std::vector<Diagnostic>& diagnostics) {
  Object* const object = find(call.object);
  const bool is_bound = object != nullptr && object->bound;
  const bool is_wanted = wants(call);
  if (is_bound && is_wanted && call.positions) reads_.expect(*object);
  if (is_wanted && call.problem) diagnostics.push_back(std::move(*call.problem));
  if (!is_bound) return;
  if (is_wanted && call.positions) {
    SetPositions last{call.object, std::move(call.positions), call.box};
    last.mesh_number = object->mesh_number;
    return apply(last);
  }
  object->bound.reset();
  object->end_view();
  // A frozen object stays frozen: if it was surveyed before, its last good positions are unknown.
  object->frozen = object->frozen || call.is_lost || (is_wanted && call.problem);
  object->state = ReadState::read;
  will_have_changed_ = true;
  if (object->frozen) return;
  object->promises.motion = 0;
  object->box = object->surface().box();
  object->seen = {object->box, true};
}

void ObjectStore::apply(const PositionsChanged& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  if (!object->bound) {
    // A call with positions may have been lost. Later promises would then not count from the positions seen
    // last.
    if (std::isinf(call.max_displacement)) object->promises.motion = call.max_displacement;
    return;
  }
  reads_.expect(*object, std::isinf(call.max_displacement));
  object->bound->notify(steps_ + 1);
  object->promises.next = call.max_displacement;
  if (std::isfinite(call.max_displacement)) object->promises.are_made = true;
}

void ObjectStore::apply(const MarkTeleport& call) {
  if (Object* const object = find(call.object)) swept_.note_jump(*object);
}

void ObjectStore::reserve(std::size_t count) {
  objects_.reserve(count);
  serials_.reserve(count);
  by_index_.reserve(count);
  removed_.reserve(count);
  departed_.reserve(count);
  reads_.reserve(count);
}

void ObjectStore::reserve_sweeps() {
  sweeps_are_reserved_ = true;
  for (const auto& object : objects_) {
    if (object == nullptr || object->sweep == nullptr) continue;
    object->sweep->motion.reserve(*object->mesh);
    bytes_.count(*object);
  }
}

std::size_t ObjectStore::byte_count() const {
  return bytes_.sum() + objects_.size() * sizeof(Object) + bytes_of(objects_) + bytes_of(serials_) +
         bytes_of(by_index_) + bytes_of(removed_) + bytes_of(departed_) + bytes_of(replaced_) +
         reads_.byte_count();
}

void ObjectStore::forget() noexcept {
  for (const auto& object : objects_) {
    if (object == nullptr) continue;
    object->end_view();
    object->surface_to_write().forget_bounds();
    object->plan = ReadPlan::skip;
    object->demand = Demand::nothing;
    object->goes_by_lists = false;
    object->asked = {};
    object->may_have_input = false;
    bytes_.count(*object);
  }
  reads_.list_anew();
  will_have_changed_ = true;
  last_failed_ = true;
}

/// Sorts the inserted objects in. If there is no memory for that, nothing has changed.
void ObjectStore::sort_in_inserted() {
  if (inserted_.empty()) return;
  const std::size_t before = objects_.size();
  objects_.reserve(before + inserted_.size());
  serials_.reserve(before + inserted_.size());
  const auto precedes = [](const auto& left, const auto& right) { return left->serial < right->serial; };
  std::sort(inserted_.begin(), inserted_.end(), precedes);
  // From the back, so that each moves once. The slot of a removed object is null, and keeps its serial.
  objects_.resize(before + inserted_.size());
  serials_.resize(objects_.size());
  std::size_t from = before;
  for (std::size_t to = objects_.size(); !inserted_.empty(); --to) {
    if (from > 0 && serials_[from - 1] > inserted_.back()->serial) {
      --from;
      serials_[to - 1] = serials_[from];
      objects_[to - 1] = std::move(objects_[from]);
    } else {
      serials_[to - 1] = inserted_.back()->serial;
      objects_[to - 1] = std::move(inserted_.back());
      inserted_.pop_back();
    }
  }
}

void ObjectStore::drop_removed() {
  if (removed_.empty()) return;
  reads_.drop_removed();
  std::erase_if(replaced_, [](const Object* object) { return object->removed; });
  std::size_t kept = 0;
  for (std::size_t slot = 0; slot < objects_.size(); ++slot) {
    if (objects_[slot] == nullptr) continue;
    serials_[kept] = serials_[slot];
    if (kept != slot) objects_[kept] = std::move(objects_[slot]);
    ++kept;
  }
  objects_.resize(kept);
  serials_.resize(kept);
  for (const auto& object : removed_) {
    discard(object->positions);
    discard(object->standing_positions);
  }
  removed_.clear();
  std::sort(departed_.begin(), departed_.end(),
            [](const DepartedObject& left, const DepartedObject& right) { return left.id < right.id; });
}

void ObjectStore::read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics,
                                 MemoryObserver* observer) {
  observer_ = observer;
  reads_.report_problems(diagnostics);  // those of a step that came to no end
  const bool has_changed = std::exchange(will_have_changed_, false);
  ++steps_;
  swept_.begin_step(std::exchange(last_failed_, false));
  sort_in_inserted();
  drop_removed();
  if (!std::exchange(promises_count_, true))
    for (const auto& object : objects_) object->promises.motion = Promises::any_distance;
  reads_.read(reads_of_step(), has_changed, tasks, diagnostics);
  mark_new_seen();
  validate(objects_);
}

void ObjectStore::read_unread(std::span<Object* const> wanted, TaskPool& tasks,
                              std::vector<Diagnostic>& diagnostics) {
  reads_.read_unread(wanted, reads_of_step(), tasks, diagnostics);
  validate(objects_);
  // The next step has to look for the pairs that this read has brought near.
  will_have_changed_ = true;
}

void ObjectStore::read_ghosts(std::span<Object* const> ghosts, TaskPool& tasks,
                              std::vector<Diagnostic>& diagnostics) {
  reads_.read_ghosts(ghosts, reads_of_step(), tasks, diagnostics);
  mark_new_seen();
  validate(objects_);
}

ReadsOfStep ObjectStore::reads_of_step() const {
  return {first_unseen_, objects_.size(), observer_};
}

/// Lets promises count from the rest positions of new objects and new meshes without input. Notes which of
/// them could not be read.
void ObjectStore::mark_new_seen() {
  const auto mark = [](Object& object) {
    if (!has_input(object)) object.promises.motion = 0;
    object.is_unplaced = object.frozen && !std::exchange(object.is_settled, false);
  };
  visit_arrived(first_unseen_, mark);
  for (Object* const object : replaced_) mark(*object);
  first_unseen_ = next_arrival_;
}

}  // namespace graze
