#include "object_store.hpp"

#include <algorithm>
#include <cmath>
#include <graze/bytes_of.hpp>
#include <graze/number_text.hpp>
#include <new>
#include <span>
#include <utility>

#include "look_slack.hpp"
#include "object_name.hpp"

namespace graze {
namespace {

/// Where structures are validated nothing is left unread, so that every promise is checked.
#ifdef GRAZE_VALIDATE
constexpr bool checks_every_promise = true;
#else
constexpr bool checks_every_promise = false;
#endif

std::string coordinates(const Eigen::Vector3d& point) {
  std::string text = number_text(point.x());
  text.append(", ").append(number_text(point.y())).append(", ").append(number_text(point.z()));
  return text;
}

/// A diagnostic with what `message` makes, or without a message where there is no memory for it. It does not
/// throw, since an object of which something was taken has to be read to its end.
template <typename Message>
Diagnostic diagnostic_of(const Object& object, DiagnosticKind kind, const Message& message) noexcept {
  Diagnostic diagnostic{object.id, kind, {}};
  try {
    diagnostic.message = message();
  } catch (const std::bad_alloc&) {
    diagnostic.message.clear();
  }
  return diagnostic;
}

Diagnostic bad_vertex(const Object& object, const Surface::ReadResult& result, const char* consequence) {
  const bool finite = result.bad_position.allFinite();
  return diagnostic_of(object, finite ? DiagnosticKind::too_large : DiagnosticKind::not_finite, [&] {
    return name_of(object.id, object) + ": vertex " + std::to_string(result.bad_vertex) + " is at " +
           coordinates(result.bad_position) + (finite ? ", beyond 2^120" : "") + "; " + consequence;
  });
}

/// Says so where a vertex that moved so far, or further, broke a promise.
std::optional<Diagnostic> check_promise(const Object& object, double displacement) {
  // The displacement is rounded; a promise kept to the last bit is not called broken.
  if (!(displacement > object.promised * round_up)) return std::nullopt;
  return diagnostic_of(object, DiagnosticKind::broken_promise, [&] {
    return name_of(object.id, object) + ": a vertex moved by " + number_text(displacement) +
           ", further than the " + number_text(object.promised) + " promised; all positions were read";
  });
}

bool is_read_in_every_step(const Object& object) {
  return object.bound && object.policy == BindPolicy::every_step;
}

/// Whether there are positions or a pose to be read.
bool has_input(const Object& object) {
  return object.positions || object.pose || is_read_in_every_step(object) || (object.bound && object.told);
}

/// Adds up what is promised of the motion since the surface's positions were read, this step's included.
void add_promise(Object& object) {
  const bool may_have_moved = is_read_in_every_step(object) || object.is_new;
  if (may_have_moved) object.promised = (object.promised + object.promise) * round_up;
  object.is_new = false;
  object.promise = std::numeric_limits<double>::infinity();
}

/// Whether an object's box will do, unless that turns out to be near another: it was in no pair of the last
/// step or can be viewed, and nobody will ask how far it has moved. What stands still is read, which then
/// writes nothing, and so is what hardly moves, of which pairs have lists.
bool can_be_surveyed(const Object& object, bool with_views) {
  return is_read_in_every_step(object) && !object.promises && !object.frozen &&
         (object.surveyed || object.moved) &&
         (!object.looked_at || (with_views && !object.is_calm && object.surface().can_view(*object.bound)));
}

/// Looks at some vertices of what an object is to be read from.
Surface::PartSeen look_at_part(const Object& object, std::uint32_t begin, std::uint32_t end) {
  if (object.to_survey) return Surface::survey(*object.mesh, *object.bound, begin, end);
  const Surface& surface = object.surface();
  if (object.pose) return surface.look_at_pose(*object.pose, begin, end);
  // A promise is held against what moved furthest, not against a bound of it.
  const bool is_held = object.has_surface && std::isfinite(object.promised);
  const auto displacement = is_held ? Surface::Displacement::exact : Surface::Displacement::bound;
  const PositionView view = object.positions ? PositionView(*object.positions) : *object.bound;
  return surface.look_at_positions(view, begin, end, displacement);
}

void write_part(Object& object, std::uint32_t begin, std::uint32_t end) {
  Surface& surface = object.surface_to_write();
  if (object.pose) return surface.write_pose(*object.pose, begin, end);
  surface.write_positions(object.positions ? PositionView(*object.positions) : *object.bound, begin, end);
}

/// Has room for one more, so that adding it does not throw.
template <typename Element>
void make_room_for_one(std::vector<Element>& elements) {
  if (elements.size() == elements.capacity()) elements.reserve(2 * elements.size() + 1);
}

bool is_same(const Box& left, const Box& right) {
  return left.min == right.min && left.max == right.max;
}

/// At least how far some vertex has moved.
double motion_between(const Box& left, const Box& right) {
  return std::max((left.min - right.min).cwiseAbs().maxCoeff(), (left.max - right.max).cwiseAbs().maxCoeff());
}

/// What came of looking at all vertices.
struct Looked {
  bool to_write = false;  ///< all vertices, and then the read is to be finished
  bool changed = false;   ///< the object stands elsewhere, or has begun or ceased to be frozen
  std::optional<Diagnostic> problem;
};

/// Whether lists of vertices pay beside another object that moves as much.
bool hardly_moves(const Object& object, double motion) {
  return list_slack_of_vertices.of(2 * motion, object.surface().leaf_size()) > 0;
}

/// For so many steps after a calm box deceived, an object is not taken to be calm.
constexpr std::uint8_t steps_until_calm = 16;

const char* const stands_still = "it stands still until good positions are read";

/// Of an object that is looked at, by its box.
bool seems_calm(Object& object, const Box& now) {
  if (object.restless_steps == 0) return hardly_moves(object, motion_between(object.box, now));
  --object.restless_steps;
  return false;
}

/// Takes what a survey saw, or says why not.
Looked take_survey(Object& object, const Surface::PartSeen& all) {
  Looked looked;
  object.frozen = all.bad_vertex != Surface::ReadResult::no_vertex;
  object.surveyed = object.unread = !object.frozen;
  if (object.frozen) {
    looked.changed = true;
    looked.problem = bad_vertex(object, {all.bad_vertex, all.bad_position}, stands_still);
  } else {
    looked.changed = !is_same(object.box, all.box);
    object.moved = looked.changed;
    object.is_calm = object.to_block && seems_calm(object, all.box);
    object.box = object.seen = all.box;
    object.has_surface = false;
    object.promised = 0;
  }
  return looked;
}

/// Takes what was seen of all vertices, or says why not.
Looked take_seen(Object& object, const Surface::PartSeen& all) {
  if (object.to_survey) return take_survey(object, all);
  const bool was_behind = object.surface().is_behind();
  const bool seems_at_rest = was_behind && is_same(object.box, all.box);
  const Surface::ReadResult result = object.surface_to_write().take(all);
  if (!was_behind && object.is_calm) {
    object.is_calm = hardly_moves(object, result.displacement);
    if (!object.is_calm && hardly_moves(object, motion_between(object.box, all.box)))
      object.restless_steps = steps_until_calm;
  }
  Looked looked{result.changed, result.changed, std::nullopt};
  // Where a view came before, it shows in the next step whether the object moves.
  object.moved = result.changed && !seems_at_rest;
  if (object.pose) {
    if (!result.taken()) looked.problem = bad_vertex(object, result, "the pose was not taken");
  } else {
    looked.changed = looked.changed || object.frozen == result.taken();
    object.frozen = !result.taken();
    looked.problem = object.frozen
                         ? bad_vertex(object, result, stands_still)
                         : check_promise(object, object.has_surface ? result.displacement
                                                                    : motion_between(object.seen, all.box));
  }
  return looked;
}

/// After all was written: lets go of what was read. Bad memory is read again until it is good.
void finish_read(Object& object) {
  if (object.to_survey) return;
  if (object.pose) {
    object.pose.reset();
  } else {
    if (object.frozen) return;
    if (!object.positions) object.told = false;
    object.positions.reset();  // as soon as they are read, so that the buffer may be lent again at once
  }
  object.unread = object.surveyed = false;
  object.promised = 0;
  object.box = object.seen = object.surface().box();
  object.has_surface = true;
  object.version = object.surface().version();
}

/// Has the surface look at the memory that was surveyed, until the next read.
void view_memory(Object& object) {
  Surface& surface = object.surface_to_write();
  surface.view(*object.bound, object.box);
  object.unread = object.surveyed = object.to_view = false;
  object.viewed = true;
  object.version = surface.version();
  if (!object.in_parts) surface.make_blocks();
}

Looked read_whole(Object& object) {
  if (object.to_view) {
    view_memory(object);
    return {};
  }
  const std::uint32_t count = object.mesh->vertex_count();
  Looked looked = take_seen(object, look_at_part(object, 0, count));
  if (looked.to_write) write_part(object, 0, count);
  if (object.to_survey && object.to_block && !object.frozen) view_memory(object);
  finish_read(object);
  return looked;
}

/// Surfaces of more vertices are read and refitted in parts, each of some tens of microseconds.
constexpr std::uint32_t vertices_each = 8192;
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
  object->in_parts = object->mesh->vertex_count() > vertices_each;
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
  by_index_[call.object.index] = nullptr;
  surface_bytes_ -= object->counted_bytes;
  object->removed = true;
  const auto place = std::lower_bound(serials_.begin(), serials_.end(), object->serial) - serials_.begin();
  removed_.push_back(std::move(objects_[static_cast<std::size_t>(place)]));
  will_have_changed_ = true;
}

void ObjectStore::apply(const SetPose& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  expect_input(*object);
  object->pose = call.rows;
}

void ObjectStore::apply(SetPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr) return;
  expect_input(*object);
  object->bound.reset();
  object->positions = std::move(call.positions);
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
  object->is_new = true;
  object->promise = std::numeric_limits<double>::infinity();
  object->promises = false;
}

void ObjectStore::apply(UnbindPositions& call) {
  Object* const object = find(call.object);
  if (object == nullptr || !object->bound) return;
  if (call.positions) {
    expect_input(*object);
    SetPositions last{call.object, std::move(call.positions)};
    return apply(last);
  }
  object->bound.reset();
  if (std::exchange(object->viewed, false)) object->surface_to_write().end_view();
  // What is frozen stays so: if it was surveyed before, nobody knows its last good positions.
  object->frozen = object->frozen || call.is_bad;
  object->unread = false;
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
  object->is_new = true;
  object->promise = call.max_displacement;
  object->promises = object->promises || std::isfinite(call.max_displacement);
}

void ObjectStore::reserve(std::size_t count) {
  objects_.reserve(count);
  serials_.reserve(count);
  by_index_.reserve(count);
  removed_.reserve(count);
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
         bytes_of(by_index_) + bytes_of(removed_) + bytes_of(with_input_) + bytes_of(to_read_) +
         bytes_of(large_) + bytes_of(parts_) + bytes_of(read_problems_) + bytes_of(problems_);
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
    object->promised = std::numeric_limits<double>::infinity();  // no promise holds
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
  removed_.clear();
}

void ObjectStore::read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  tell_problems(diagnostics);  // those of a step that came to no end
  changed_ = std::exchange(will_have_changed_, false);
  drop_removed();
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

/// Leaves an object unread where promises allow it, and lists it otherwise.
void ObjectStore::take_input(Object& object) {
  add_promise(object);
  if (std::exchange(object.viewed, false)) object.surface_to_write().end_view();
  object.to_survey = can_be_surveyed(object, with_blocks_);
  if (object.to_survey) ++surveyed_count_;
  const bool was_looked_at = std::exchange(object.looked_at, false);
  object.goes_by_lists = was_looked_at && !std::exchange(object.asked_for_blocks, false);
  object.to_block = with_blocks_ && was_looked_at && !object.goes_by_lists;
  const bool was_unread = object.unread;
  object.unread = !checks_every_promise && !object.pose && !object.frozen && std::isfinite(object.promised);
  if ((was_unread && !object.to_survey) || object.unread) changed_ = true;
  if (!object.unread) return list_to_read(object);
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
    object->to_view = with_blocks_ && object->surveyed && object->surface().can_view(*object->bound);
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
  if (!object.in_parts) return to_read_.push_back(&object);
  const std::uint32_t count = object.mesh->vertex_count();
  for (std::uint32_t begin = 0; begin < count; begin += vertices_each)
    parts_.push_back({&object, begin, std::min(vertices_each, count - begin), {}});
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
  if (object.to_block && !object.viewed) object.surface_to_write().make_blocks();
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
    for (const LargeObject& large : std::span(large_).first(taken)) finish_read(*large.object);
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
  auto& [object, end, problem] = large_[place];
  const std::size_t begin = place == 0 ? 0 : large_[place - 1].end;
  Surface::PartSeen all;
  for (std::size_t part = begin; part < end; ++part) all.add(parts_[part].seen);
  Looked looked = take_seen(*object, all);
  if (object->to_survey && object->to_block && !object->frozen) view_memory(*object);
  if (looked.changed) changed_ = true;
  if (looked.problem) {
    problem = std::move(looked.problem);
    some_problems_ = true;
  }
  if (!looked.to_write) return;
  for (std::size_t part = begin; part < end; ++part) parts_[to_write++] = parts_[part];
}

}  // namespace graze
