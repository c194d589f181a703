#include "object_store.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <graze/bytes_of.hpp>
#include <new>
#include <span>
#include <utility>

#include "object_reading.hpp"

namespace graze {
namespace {

/// Where structures are validated nothing is left unread, so that every promise is checked.
#ifdef GRAZE_VALIDATE
constexpr bool checks_every_promise = true;
#else
constexpr bool checks_every_promise = false;
#endif

/// Has room for one more, so that adding it does not throw.
template <typename Element>
void make_room_for_one(std::vector<Element>& elements) {
  if (elements.size() == elements.capacity()) elements.reserve(2 * elements.size() + 1);
}

/// A removed object's copies have no use for anybody.
void let_go(SparePositions::Loan& positions) {
  if (positions == nullptr) return;
  positions.get_deleter().is_last = true;
  positions.reset();
}

/// Surfaces of more vertices are read and refitted in parts, each of some tens of microseconds.
constexpr std::uint32_t vertices_of_part = 8192;
/// Small ones are read several at a time, in so many tasks at least: neighbours mostly lie beside each other
/// in the caller's memory, too.
constexpr std::size_t least_batches = 64;

}  // namespace

Object* ObjectStore::find(ObjectId id) {
  if (id.index >= by_index_.size() || by_index_[id.index] == nullptr) return nullptr;
  Object* const object = by_index_[id.index];
  return object->id == id ? object : nullptr;
}

void ObjectStore::apply(AddObject& call) {
  auto object = std::make_unique<Object>();
  make_room_for_one(serials_);
  make_room_for_one(objects_);
  if (by_index_.size() <= call.object.index) by_index_.resize(call.object.index + std::size_t{1}, nullptr);
  // From here on nothing throws.
  object->id = call.object;
  object->serial = next_serial_++;
  object->settings = std::move(call.settings);
  object->owned_surface = std::move(call.surface);
  object->box = object->seen = object->surface().box();
  object->version = object->surface().version();
  object->mesh = &object->surface().mesh();
  object->in_parts = object->mesh->vertex_count() > vertices_of_part;
  count_bytes(*object);
  by_index_[call.object.index] = object.get();
  serials_.push_back(object->serial);
  objects_.push_back(std::move(object));
  will_have_changed_ = true;
}

void ObjectStore::apply(const RemoveObject& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  make_room_for_one(removed_);
  make_room_for_one(departed_);
  by_index_[call.object.index] = nullptr;
  surface_bytes_ -= object->counted_bytes;
  object->removed = true;
  const auto place = std::lower_bound(serials_.begin(), serials_.end(), object->serial) - serials_.begin();
  departed_.push_back({object->id, object->serial});
  removed_.push_back(std::move(objects_[static_cast<std::size_t>(place)]));
  will_have_changed_ = true;
}

void ObjectStore::apply(const SetPose& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  if (std::exchange(object->frozen, false)) will_have_changed_ = true;
  // It stands there, or a survey has seen it there.
  if (object->standing_pose && std::memcmp(&*object->standing_pose, &call.rows, sizeof(Pose)) == 0) {
    object->pose.reset();
  } else {
    expect_input(*object);
    object->pose = call.rows;
  }
}

/// A good pose of the same step that came before is not taken either.
void ObjectStore::apply(const RefusePose& call) noexcept {
  Object* const object = find(call.problem.object);
  if (object == nullptr) return;
  object->pose.reset();
  if (!std::exchange(object->frozen, true)) will_have_changed_ = true;
}

void ObjectStore::apply(SetPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  expect_input(*object);
  object->bound.reset();
  object->positions = std::move(call.positions);
  object->box_of_positions = call.box;
  object->is_new = true;
  object->promise = call.max_displacement;
}

void ObjectStore::apply(const BindPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  expect_input(*object);
  object->positions.reset();
  object->bound = call.view;
  object->moved = true;  // it may be anywhere
  object->policy = call.policy;
  object->told = true;
  object->told_step = 0;
  object->is_told_again = false;
  object->is_new = true;
  object->promise = std::numeric_limits<double>::infinity();
  object->promises = false;
}

void ObjectStore::apply(UnbindPositions& call, std::vector<Diagnostic>& diagnostics) {
  Object* const object = find(call.object);
  const bool is_bound = object != nullptr && object->bound;
  // What was only surveyed has been read nowhere else.
  const bool is_wanted = call.is_due || (is_bound && object->unread && object->surveyed);
  if (is_bound && is_wanted && call.positions) expect_input(*object);
  if (is_wanted && call.problem) diagnostics.push_back(std::move(*call.problem));
  if (!is_bound) return;
  if (is_wanted && call.positions) {
    SetPositions last{call.object, std::move(call.positions), call.box};
    return apply(last);
  }
  object->bound.reset();
  if (std::exchange(object->viewed, false)) object->surface_to_write().end_view();
  // What is frozen stays so: if it was surveyed before, nobody knows its last good positions.
  object->frozen = object->frozen || call.is_lost || (is_wanted && call.problem);
  object->unread = object->surveyed = false;
  will_have_changed_ = true;
  if (object->frozen) return;
  object->promised = 0;
  object->box = object->seen = object->surface().box();
  object->has_surface = true;
}

void ObjectStore::apply(const PositionsChanged& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  if (!object->bound) {
    // A call with positions may have been lost, so that what is promised later is not of those seen last.
    if (std::isinf(call.max_displacement)) object->promised = call.max_displacement;
    return;
  }
  expect_input(*object);
  object->told = true;
  if (object->told_step != steps_ + 1) object->is_told_again = object->told_step == steps_;
  object->told_step = steps_ + 1;
  object->is_new = true;
  object->promise = call.max_displacement;
  object->promises = object->promises || std::isfinite(call.max_displacement);
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

void ObjectStore::count_bytes(Object& object) {
  const std::size_t bytes = object.surface().byte_count();
  surface_bytes_ += bytes - std::exchange(object.counted_bytes, bytes);
}

std::size_t ObjectStore::byte_count() const {
  return surface_bytes_ + objects_.size() * sizeof(Object) + bytes_of(objects_) + bytes_of(serials_) +
         bytes_of(by_index_) + bytes_of(removed_) + bytes_of(departed_) + bytes_of(with_input_) +
         bytes_of(to_read_) + bytes_of(large_) + bytes_of(parts_) + bytes_of(read_problems_) +
         bytes_of(problems_);
}

void ObjectStore::expect_input(Object& object) {
  if (object.may_have_input) return;
  with_input_.push_back(&object);
  object.may_have_input = true;
}

void ObjectStore::forget() noexcept {
  for (const auto& object : objects_) {
    if (object == nullptr) continue;
    if (std::exchange(object->viewed, false)) object->surface_to_write().end_view();
    object->surface_to_write().forget_bounds();
    object->looked_at = object->asked_for_blocks = object->goes_by_lists = object->wanted = false;
    object->to_block = object->to_view = object->to_survey = false;
    object->asked = {};
    object->may_have_input = false;
    count_bytes(*object);
  }
  // The step may have been going through this list. Then some objects are in it twice, and none is missing.
  std::erase_if(with_input_, [](Object* object) { return std::exchange(object->may_have_input, true); });
  will_have_changed_ = true;
}

void ObjectStore::drop_removed() {
  if (removed_.empty()) return;
  std::erase_if(with_input_, [](const Object* object) { return object->removed; });
  std::size_t kept = 0;
  for (std::size_t place = 0; place < objects_.size(); ++place) {
    if (objects_[place] == nullptr) continue;
    serials_[kept] = serials_[place];
    if (kept != place) objects_[kept] = std::move(objects_[place]);
    ++kept;
  }
  objects_.resize(kept);
  serials_.resize(kept);
  for (const auto& object : removed_) {
    let_go(object->positions);
    let_go(object->standing_positions);
  }
  removed_.clear();
  std::sort(departed_.begin(), departed_.end(),
            [](const DepartedObject& left, const DepartedObject& right) { return left.id < right.id; });
}

void ObjectStore::read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  tell_problems(diagnostics);  // those of a step that came to no end
  changed_ = std::exchange(will_have_changed_, false);
  ++steps_;
  drop_removed();
  if (!std::exchange(promises_count_, true))
    for (const auto& object : objects_) object->promised = std::numeric_limits<double>::infinity();
  begin_list();
  unread_count_ = surveyed_count_ = 0;
  // One pass: by the next one the first objects would have left the caches.
  std::erase_if(with_input_, [&](Object* object) {
    object->may_have_input = has_input(*object);
    if (object->may_have_input) take_input(*object);
    return !object->may_have_input;
  });
  read_listed(tasks, diagnostics);
  see_new();
}

/// Leaves an object unread where promises or a survey allow it, and lists it otherwise.
void ObjectStore::take_input(Object& object) {
  object.stays_unread = stays_unread(object);
  if (object.stays_unread) return;
  add_promise(object);
  if (std::exchange(object.viewed, false)) object.surface_to_write().end_view();
  object.to_survey = can_be_surveyed(object, with_blocks_);
  if (object.to_survey) ++surveyed_count_;
  const bool was_looked_at = std::exchange(object.looked_at, false);
  object.goes_by_lists = was_looked_at && !std::exchange(object.asked_for_blocks, false);
  object.to_block = with_blocks_ && was_looked_at && !object.goes_by_lists;
  const bool was_unread = object.unread;
  // A pose that turns out to be none leaves the object as it is, read or not.
  if (!object.pose) object.unread = !checks_every_promise && !object.frozen && std::isfinite(object.promised);
  if ((was_unread && !object.to_survey) || object.unread) changed_ = true;
  if (!object.unread || object.pose) return list_to_read(object);
  object.box = grown(object.seen, object.promised);
  object.surveyed = false;
  ++unread_count_;
}

/// From now on promises may speak of where new objects are that stand as they rest.
void ObjectStore::see_new() {
  for (auto object = objects_.rbegin(); object != objects_.rend() && (*object)->serial >= first_unseen_;
       ++object)
    if (!has_input(**object)) (*object)->promised = 0;
  first_unseen_ = next_serial_;
}

void ObjectStore::read_unread(std::vector<Object*>& wanted, TaskPool& tasks,
                              std::vector<Diagnostic>& diagnostics) {
  begin_list();
  for (Object* const object : wanted) {
    if (!object->surveyed) --unread_count_;
    object->wanted = object->to_survey = false;
    object->to_block = with_blocks_ && !object->goes_by_lists;
    object->to_view = with_blocks_ && object->surveyed && can_be_viewed(*object);
    if (object->to_view && object->in_parts)
      view_memory(*object);
    else
      list_to_read(*object);
  }
  read_listed(tasks, diagnostics);
  // The next step finds what pairs have come by this.
  will_have_changed_ = true;
}

void ObjectStore::begin_list() {
  to_read_.clear();
  large_.clear();
  parts_.clear();
}

void ObjectStore::list_to_read(Object& object) {
  if (!object.in_parts || (object.to_survey && has_known_box(object))) return to_read_.push_back(&object);
  const std::uint32_t count = object.mesh->vertex_count();
  for (std::uint32_t begin = 0; begin < count; begin += vertices_of_part)
    parts_.push_back({&object, begin, std::min(vertices_of_part, count - begin), {}});
  large_.push_back({&object, parts_.size()});
}

/// Reads an object of `to_read_`, while other threads read others.
void ObjectStore::read_small(std::size_t place) {
  Object& object = *to_read_[place];
  const AccessScope access({AccessRight::write(&object), {}});
  Looked looked = read_whole(object);
  if (looked.changed) changed_.store(true, std::memory_order_relaxed);
  if (looked.problem) {
    read_problems_[place] = std::move(looked.problem);
    some_problems_.store(true, std::memory_order_relaxed);
  }
  // Last, since there may be no memory for it.
  if (object.to_block && !object.to_survey) object.surface_to_write().make_blocks();
}

void ObjectStore::read_listed(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  // A task writes its own objects and their own places in read_problems_, or looks at its own vertices of an
  // object and writes its own part; nothing is shared.
  if (read_problems_.size() < to_read_.size()) read_problems_.resize(to_read_.size());
  const std::size_t each = std::max<std::size_t>(1, to_read_.size() / least_batches);
  const std::size_t batches = (to_read_.size() + each - 1) / each;
  tasks.run(parts_.size() + batches, [&](unsigned, std::size_t item) {
    if (item < parts_.size()) {
      Part& part = parts_[item];
      const AccessScope access({AccessRight::read(), {}});
      part.seen = look_at_part(*part.object, part.begin, part.begin + part.count);
    } else {
      const std::size_t begin = (item - parts_.size()) * each;
      const std::size_t end = std::min(begin + each, to_read_.size());
      for (std::size_t place = begin; place < end; ++place) read_small(place);
    }
  });
  take_large(tasks);
  tell_problems(diagnostics);
}

/// Appends what the last read found wrong, in the objects' order. Where there is no memory for it, it is to
/// be told still.
void ObjectStore::tell_problems(std::vector<Diagnostic>& diagnostics) {
  if (!some_problems_) return;
  const auto gather = [&](const Object& object, std::optional<Diagnostic>& problem) {
    if (!problem) return;
    problems_.emplace_back(object.serial, std::move(*problem));
    problem.reset();
  };
  for (std::size_t place = 0; place < std::min(to_read_.size(), read_problems_.size()); ++place)
    gather(*to_read_[place], read_problems_[place]);
  for (LargeObject& large : large_) gather(*large.object, large.problem);
  std::sort(problems_.begin(), problems_.end(),
            [](const auto& left, const auto& right) { return left.first < right.first; });
  diagnostics.reserve(diagnostics.size() + problems_.size());
  for (auto& [serial, problem] : problems_) diagnostics.push_back(std::move(problem));
  problems_.clear();
  some_problems_ = false;
}

/// Takes what was seen of the large objects' parts, and writes those of the objects that changed.
void ObjectStore::take_large(TaskPool& tasks) {
  std::size_t taken = 0;
  std::size_t to_write = 0;
  const auto write_taken = [&] {
    tasks.run(to_write, [&](unsigned, std::size_t item) {
      // The last ones first, which are still in a cache.
      const auto& [object, begin, count, seen] = parts_[to_write - 1 - item];
      const AccessScope access({AccessRight::write(object), {}});
      write_part(*object, begin, begin + count);
    });
    for (const LargeObject& large : std::span(large_).first(taken)) finish_read(*large.object, large.taken);
  };
  try {
    for (; taken < large_.size(); ++taken) take_parts(taken, to_write);
  } catch (...) {
    write_taken();  // what was taken has to be written, though there is no memory for the rest
    throw;
  }
  write_taken();
}

/// Takes what was seen of one of them, and lists its parts before `to_write` if they are to be written.
void ObjectStore::take_parts(std::size_t place, std::size_t& to_write) {
  auto& [object, end, problem, taken] = large_[place];
  const std::size_t begin = place == 0 ? 0 : large_[place - 1].end;
  Surface::PartSeen all;
  for (std::size_t part = begin; part < end; ++part) all.add(parts_[part].seen);
  Looked looked = take_seen(*object, all);
  if (object->to_survey && object->to_block && !object->frozen) view_memory(*object);
  taken = looked.taken;
  if (looked.changed) changed_ = true;
  if (looked.problem) {
    problem = std::move(looked.problem);
    some_problems_ = true;
  }
  if (!looked.to_write) return;
  for (std::size_t part = begin; part < end; ++part) parts_[to_write++] = parts_[part];
}

}  // namespace graze
