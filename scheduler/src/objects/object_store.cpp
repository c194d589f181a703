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

/// Builds that validate structures leave nothing unread, so that they check every promise.
#ifdef GRAZE_VALIDATE
constexpr bool checks_every_promise = true;
#else
constexpr bool checks_every_promise = false;
#endif

/// Surfaces with more vertices than this are read and refitted in parts, each of which takes some tens of
/// microseconds.
constexpr std::uint32_t vertices_of_part = 8192;

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

/// Whether an object may stay unread, if its promises keep it far from everything.
bool may_stay_unread(const Object& object) {
  return !checks_every_promise && !object.pose && !object.frozen && !object.settings.queries &&
         object.promises.are_bounds() && object.sweep == nullptr;
}

/// The least number of tasks for small objects. Each task reads several of them, which are mostly neighbours
/// in the caller's memory, too.
constexpr std::size_t least_batches = 64;

/// About how long it takes on one thread to read a vertex.
constexpr double nanoseconds_each_vertex = 2;

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
void ObjectStore::take_up_sweep(const ObjectSettings& settings) {
  if (!swept_.take_up(settings)) return;
  for (const auto& object : objects_) {
    if (object == nullptr || object->sweep != nullptr || !swept_.may_meet(object->settings)) continue;
    make_sweep(*object, *object->mesh);
    if (object->is_unread()) expect_input(*object);
  }
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
  make_room_for_one(serials_);
  make_room_for_one(objects_);
  if (by_index_.size() <= call.object.index) by_index_.resize(call.object.index + std::size_t{1}, nullptr);
  // From here on nothing throws.
  object->id = call.object;
  object->serial = next_serial_++;
  object->settings = std::move(call.settings);
  object->face_groups = std::move(call.face_groups);
  object->self = std::move(call.self);
  object->users_mesh = std::move(call.mesh);
  put_surface(*object, std::move(call.surface));
  count_bytes(*object);
  by_index_[call.object.index] = object.get();
  serials_.push_back(object->serial);
  objects_.push_back(std::move(object));
  will_have_changed_ = true;
}

/// The object is what an added one would be. But a posed one keeps its pose, or waits for a good one still.
void ObjectStore::apply(ReplaceMesh& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  make_room_for_one(with_input_);
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
  Object now;
  now.id = object->id;
  now.serial = object->serial;
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
  count_bytes(*object);
  if (object->pose) expect_input(*object);
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
  by_index_[call.object.index] = nullptr;
  surface_bytes_ -= object->counted_bytes;
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
    expect_input(*object);
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
  if (object->pose) settle_pose(*object);
}

void ObjectStore::apply(SetPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr || is_outdated(call)) return;
  expect_input(*object);
  object->bound.reset();
  object->positions = std::move(call.positions);
  object->box_of_positions = call.box;
  object->promises.next = call.max_displacement;
}

void ObjectStore::apply(const BindPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  expect_input(*object);
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
  if (is_bound && is_wanted && call.positions) expect_input(*object);
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
  expect_input(*object);
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
  with_input_.reserve(count);
  to_read_.reserve(count);
  read_problems_.reserve(count);
}

void ObjectStore::reserve_sweeps() {
  sweeps_are_reserved_ = true;
  for (const auto& object : objects_) {
    if (object == nullptr || object->sweep == nullptr) continue;
    object->sweep->motion.reserve(*object->mesh);
    count_bytes(*object);
  }
}

void ObjectStore::count_bytes(Object& object) {
  const std::size_t bytes = object.surface().byte_count() +
                            (object.face_groups == nullptr ? 0 : object.face_groups->byte_count()) +
                            (object.sweep == nullptr ? 0 : object.sweep->motion.byte_count()) +
                            (object.self == nullptr ? 0 : object.self->byte_count());
  surface_bytes_ += bytes - std::exchange(object.counted_bytes, bytes);
}

std::size_t ObjectStore::byte_count() const {
  return surface_bytes_ + objects_.size() * sizeof(Object) + bytes_of(objects_) + bytes_of(serials_) +
         bytes_of(by_index_) + bytes_of(removed_) + bytes_of(departed_) + bytes_of(replaced_) +
         bytes_of(with_input_) + bytes_of(to_read_) + bytes_of(large_) + bytes_of(parts_) +
         bytes_of(read_problems_) + bytes_of(problems_);
}

void ObjectStore::expect_input(Object& object) {
  if (object.may_have_input) return;
  with_input_.push_back(&object);
  object.may_have_input = true;
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
    count_bytes(*object);
  }
  // The step may have failed while it went through this list. Then some objects are listed twice, and none is
  // missing.
  std::erase_if(with_input_, [](Object* object) { return std::exchange(object->may_have_input, true); });
  will_have_changed_ = true;
  last_failed_ = true;
}

void ObjectStore::drop_removed() {
  if (removed_.empty()) return;
  for (auto* const list : {&with_input_, &replaced_})
    std::erase_if(*list, [](const Object* object) { return object->removed; });
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
  report_problems(diagnostics);  // those of a step that came to no end
  changed_ = std::exchange(will_have_changed_, false);
  ++steps_;
  swept_.begin_step(std::exchange(last_failed_, false));
  drop_removed();
  if (!std::exchange(promises_count_, true))
    for (const auto& object : objects_) object->promises.motion = Promises::any_distance;
  clear_read_list();
  unread_count_ = surveyed_count_ = 0;
  // Everything is done in one pass, since a second pass would find the first objects out of the caches.
  std::erase_if(with_input_, [&](Object* object) {
    object->may_have_input = has_input(*object);
    if (!object->may_have_input) return true;
    plan_read(*object);
    return false;
  });
  read_listed(tasks, diagnostics);
  if (observer_ != nullptr) {
    for (Object* const object : to_read_) show_memory(*object);
    for (const LargeObject& large : large_) show_memory(*large.object);
  }
  mark_new_seen();
  validate(objects_);
}

/// Decides how an object with input is read. It stays unread if promises allow that, and is listed otherwise.
void ObjectStore::plan_read(Object& object) {
  if (stays_unread(object)) {
    object.state = ReadState::still_surveyed;
    return;
  }
  add_promise(object);
  object.end_view();
  const bool surveys = can_be_surveyed(object, with_blocks_);
  if (surveys) ++surveyed_count_;
  const Demand demand = std::exchange(object.demand, Demand::nothing);
  object.goes_by_lists = demand == Demand::test;
  if (object.is_unread() && (object.pose || !surveys)) changed_ = true;
  if (may_stay_unread(object)) return leave_unread(object);
  if (demand == Demand::blocks)
    object.plan = surveys ? ReadPlan::survey_and_view : ReadPlan::read_with_blocks;
  else
    object.plan = surveys ? ReadPlan::survey : ReadPlan::read;
  // A pose that is refused later leaves the object as it is, read or surveyed.
  if (object.was_surveyed())
    object.state = object.pose ? ReadState::surveyed : ReadState::due;
  else
    object.state = ReadState::read;
  list_to_read(object);
}

/// Leaves an object unread that promises keep far from everything.
void ObjectStore::leave_unread(Object& object) {
  object.state = ReadState::unread;
  object.box = grown(object.seen.box, object.promises.motion);
  ++unread_count_;
  changed_ = true;
}

/// Lets promises count from the rest positions of new objects and new meshes without input. Notes which of
/// them could not be read.
void ObjectStore::mark_new_seen() {
  const auto mark = [](Object& object) {
    if (!has_input(object)) object.promises.motion = 0;
    object.is_unplaced = object.frozen && !std::exchange(object.is_settled, false);
  };
  for (auto object = objects_.rbegin(); object != objects_.rend() && (*object)->serial >= first_unseen_;
       ++object)
    mark(**object);
  for (Object* const object : replaced_) mark(*object);
  first_unseen_ = next_serial_;
}

void ObjectStore::read_unread(std::vector<Object*>& wanted, TaskPool& tasks,
                              std::vector<Diagnostic>& diagnostics) {
  clear_read_list();
  for (Object* const object : wanted) {
    if (!object->is_surveyed()) --unread_count_;
    plan_late_read(*object);
  }
  read_listed(tasks, diagnostics);
  if (observer_ != nullptr)
    for (Object* const object : wanted) show_memory(*object);
  validate(objects_);
  // The next step has to look for the pairs that this read has brought near.
  will_have_changed_ = true;
}

/// Lists an unread object that is near others, or views it at once if it is large.
void ObjectStore::plan_late_read(Object& object) {
  const bool views = with_blocks_ && object.is_surveyed() && can_be_viewed(object);
  if (views && object.in_parts) {
    object.plan = ReadPlan::skip;
    return view_memory(object);
  }
  const bool makes_blocks = with_blocks_ && !object.goes_by_lists;
  object.plan = views ? ReadPlan::view : makes_blocks ? ReadPlan::read_with_blocks : ReadPlan::read;
  list_to_read(object);
}

/// Shows the observer the memory of an object that was read, where it may be new.
void ObjectStore::show_memory(Object& object) {
  if (object.bound && std::exchange(object.is_unobserved, false)) observer_->see_memory(object);
}

void ObjectStore::clear_read_list() {
  to_read_.clear();
  vertices_to_read_ = 0;
  large_.clear();
  parts_.clear();
}

void ObjectStore::list_to_read(Object& object) {
  vertices_to_read_ += object.mesh->vertex_count();
  if (!object.in_parts || (is_survey(object.plan) && has_known_box(object)))
    return to_read_.push_back(&object);
  const std::uint32_t count = object.mesh->vertex_count();
  const bool keeps_start = swept_.begin_keeping(object, is_new(object));
  for (std::uint32_t begin = 0; begin < count; begin += vertices_of_part)
    parts_.push_back({&object, begin, std::min(vertices_of_part, count - begin), {}, keeps_start});
  large_.push_back({&object, parts_.size(), keeps_start});
}

/// Reads one object of `to_read_`. Other threads read other objects at the same time.
void ObjectStore::read_small(std::size_t index) {
  Object& object = *to_read_[index];
  const AccessScope access({AccessRight::write(&object), {}});
  if (object.sweep != nullptr && swept_.begin_keeping(object, is_new(object))) {
    object.sweep->motion.keep(object.surface(), 0, object.mesh->vertex_count());
    swept_.end_keeping(object);
  }
  ReadOutcome outcome = read_whole(object);
  object.is_unplaced = object.is_unplaced && object.frozen;
  // It is looked at first: tasks that only read it do not take the cache line from each other.
  if (outcome.changed && !changed_.load(std::memory_order_relaxed))
    changed_.store(true, std::memory_order_relaxed);
  if (outcome.problem) {
    read_problems_[index] = std::move(outcome.problem);
    some_problems_.store(true, std::memory_order_relaxed);
  }
  // This comes last, since it may throw for lack of memory.
  if (std::exchange(object.plan, ReadPlan::skip) == ReadPlan::read_with_blocks)
    object.surface_to_write().make_blocks();
}

void ObjectStore::read_listed(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  // A task writes its own objects and their own entries of read_problems_. Or it reads its own vertices of a
  // large object and writes its own part. Tasks share no data that is written.
  if (read_problems_.size() < to_read_.size()) read_problems_.resize(to_read_.size());
  const std::size_t each = std::max<std::size_t>(1, to_read_.size() / least_batches);
  const std::size_t batches = (to_read_.size() + each - 1) / each;
  const auto read = [&](unsigned, std::size_t item) {
    if (item < parts_.size()) {
      Part& part = parts_[item];
      const AccessScope access({AccessRight::read(), {}});
      if (part.keeps_start)
        part.object->sweep->motion.keep(part.object->surface(), part.begin, part.begin + part.count);
      part.seen = scan_part(*part.object, part.begin, part.begin + part.count);
    } else {
      const std::size_t begin = (item - parts_.size()) * each;
      const std::size_t end = std::min(begin + each, to_read_.size());
      for (std::size_t index = begin; index < end; ++index) read_small(index);
    }
  };
  // The lambda is passed by reference, since std::function would allocate for what it captures.
  tasks.run(parts_.size() + batches, std::cref(read),
            {.nanoseconds = nanoseconds_each_vertex * static_cast<double>(vertices_to_read_)});
  finish_large(tasks);
  report_problems(diagnostics);
}

/// Appends the problems that the last read found, in the order of the objects. If there is no memory for
/// them, they stay for the next call.
void ObjectStore::report_problems(std::vector<Diagnostic>& diagnostics) {
  if (!some_problems_) return;
  const auto gather = [&](const Object& object, std::optional<Diagnostic>& problem) {
    if (!problem) return;
    problems_.emplace_back(object.serial, std::move(*problem));
    problem.reset();
  };
  for (std::size_t index = 0; index < std::min(to_read_.size(), read_problems_.size()); ++index)
    gather(*to_read_[index], read_problems_[index]);
  for (LargeObject& large : large_) gather(*large.object, large.problem);
  std::sort(problems_.begin(), problems_.end(),
            [](const auto& left, const auto& right) { return left.first < right.first; });
  diagnostics.reserve(diagnostics.size() + problems_.size());
  for (auto& [serial, problem] : problems_) diagnostics.push_back(std::move(problem));
  problems_.clear();
  some_problems_ = false;
}

/// Accepts the scans of the large objects, and writes the parts of those that changed.
void ObjectStore::finish_large(TaskPool& tasks) {
  std::size_t finished = 0;
  std::size_t to_write = 0;
  const auto write_finished = [&] {
    tasks.run(to_write, [&](unsigned, std::size_t item) {
      // The last parts come first, since they are still in a cache.
      const Part& part = parts_[to_write - 1 - item];
      const AccessScope access({AccessRight::write(part.object), {}});
      write_part(*part.object, part.begin, part.begin + part.count);
    });
    for (const LargeObject& large : std::span(large_).first(finished)) {
      finish_read(*large.object, large.accepted);
      large.object->plan = ReadPlan::skip;
    }
  };
  try {
    for (; finished < large_.size(); ++finished) finish_parts(finished, to_write);
  } catch (...) {
    write_finished();  // accepted objects have to be written even without memory for the rest
    throw;
  }
  write_finished();
}

/// Accepts the scan of one large object. If it is to be written, its parts are moved to the front of
/// `parts_`, before `to_write`.
void ObjectStore::finish_parts(std::size_t index, std::size_t& to_write) {
  auto& [object, end, keeps_start, problem, accepted] = large_[index];
  const std::size_t begin = index == 0 ? 0 : large_[index - 1].end;
  Surface::PartSeen all;
  for (std::size_t part = begin; part < end; ++part) all.add(parts_[part].seen);
  if (keeps_start) swept_.end_keeping(*object);
  ReadOutcome outcome = accept_scan(*object, all);
  object->is_unplaced = object->is_unplaced && object->frozen;
  if (object->plan == ReadPlan::survey_and_view && !object->frozen) view_memory(*object);
  accepted = outcome.accepted;
  if (outcome.changed) changed_ = true;
  if (outcome.problem) {
    problem = std::move(outcome.problem);
    some_problems_ = true;
  }
  if (!outcome.to_write) return;
  for (std::size_t part = begin; part < end; ++part) parts_[to_write++] = parts_[part];
}

}  // namespace graze
