#include "objects/position_reads.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "core/base/growth_policy.hpp"
#include "core/base/prefetch.hpp"
#include "objects/object_reading.hpp"

namespace graze {
namespace {

/// Builds that validate structures leave nothing unread, so that they check every promise.
#ifdef GRAZE_VALIDATE
constexpr bool checks_every_promise = true;
#else
constexpr bool checks_every_promise = false;
#endif

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
constexpr double nanoseconds_each_written = 1;
/// To plan the read of an object takes about as long, whether or not it is read then.
constexpr double nanoseconds_each_plan = 40;

/// How many objects ahead of the one that is read the next is fetched from memory.
constexpr std::size_t objects_ahead = 3;

void prefetch_range(const void* begin, std::size_t count) {
  constexpr std::size_t line = 64;
  const auto* const bytes = static_cast<const std::byte*>(begin);
  for (std::size_t at = 0; at < count; at += line) prefetch(bytes + at);
}

/// Fetches the memory of the object that is read next. The processor finds the rest of a long range by
/// itself.
void prefetch_memory(const Object& object) {
  constexpr std::size_t most = 4096;
  if (!object.bound || !(object.is_read_in_every_step() || object.bound->is_notified)) return;
  const PositionView& view = object.bound->view;
  prefetch_range(view.data(), std::min(most, view.size() * view.stride_bytes()));
}

double nanoseconds_of(std::size_t planned, std::size_t vertices) {
  return nanoseconds_each_plan * static_cast<double>(planned) +
         nanoseconds_each_vertex * static_cast<double>(vertices);
}

constexpr std::size_t batches_of(std::size_t count, std::size_t each) {
  return (count + each - 1) / each;
}

constexpr std::size_t objects_of_batch(std::size_t count) {
  return std::max<std::size_t>(1, count / least_batches);
}

template <typename Element>
void make_room(std::vector<Element>& elements, std::size_t count) {
  if (elements.capacity() < count) elements.reserve(with_growth_room(count));
}

}  // namespace

void PositionReads::expect(Object& object, bool is_read) {
  const bool is_new_here = !object.may_have_input || object.is_unread();
  if (!object.in_parts && is_read && is_new_here) vertices_expected_ += object.mesh->vertex_count();
  if (object.may_have_input) return;
  (object.in_parts ? large_ : small_).push_back(&object);
  object.may_have_input = true;
}

void PositionReads::make_room_for_one() {
  for (auto* const list : {&small_, &large_})
    if (list->size() == list->capacity()) list->reserve(2 * list->size() + 1);
}

void PositionReads::sort_in(Object& object) {
  if (!object.may_have_input) return;
  std::erase(object.in_parts ? small_ : large_, &object);
  (object.in_parts ? large_ : small_).push_back(&object);
}

void PositionReads::drop_removed() {
  drop_those_without_input();
  for (auto* const list : {&small_, &large_})
    std::erase_if(*list, [](const Object* object) { return object->removed; });
}

void PositionReads::drop_those_without_input() {
  if (some_dropped_) std::erase(small_, nullptr);
  some_dropped_ = false;
}

void PositionReads::reserve(std::size_t count) {
  small_.reserve(count);
  large_.reserve(count);
  planned_.reserve(count);
  found_.reserve(count);
}

void PositionReads::list_anew() noexcept {
  drop_those_without_input();
  for (auto* const list : {&small_, &large_})
    std::erase_if(*list, [](Object* object) { return std::exchange(object->may_have_input, true); });
}

void PositionReads::begin(const ReadsOfStep& step) {
  step_ = step;
  planned_.clear();
  in_parts_.clear();
  parts_.clear();
  was_read_.clear();
  vertices_to_read_ = 0;
}

void PositionReads::read(const ReadsOfStep& step, bool has_changed, TaskPool& tasks,
                         std::vector<Diagnostic>& diagnostics) {
  begin(step);
  drop_those_without_input();
  changed_ = has_changed;
  unread_count_ = surveyed_count_ = vertices_read_ = 0;
  if (step.observer != nullptr) note_which_are_read();
  make_room_for_late();
  plan_large();
  read_all(small_, nanoseconds_of(small_.size(), vertices_expected_ + vertices_to_read_), tasks);
  vertices_expected_ = vertices_read_;
  report_problems(diagnostics);
  if (step.observer != nullptr) show_what_was_read();
}

/// Any object may be read late.
void PositionReads::make_room_for_late() {
  make_room(planned_, step_.objects);
  make_room(found_, step_.objects);
}

void PositionReads::note_which_are_read() {
  make_room(was_read_, small_.size());
  was_read_.resize(small_.size());
}

void PositionReads::plan_large() {
  std::erase_if(large_, [&](Object* object) {
    Counts counts;
    object->may_have_input = has_input(*object);
    if (object->may_have_input && plan(*object, counts)) list_planned(*object);
    add(counts);
    return !object->may_have_input;
  });
}

void PositionReads::read_unread(std::span<Object* const> wanted, const ReadsOfStep& step, TaskPool& tasks,
                                std::vector<Diagnostic>& diagnostics) {
  begin(step);
  for (Object* const object : wanted) {
    if (!object->is_surveyed()) --unread_count_;
    plan_late(*object);
  }
  read_all({}, nanoseconds_of(0, vertices_to_read_), tasks);
  report_problems(diagnostics);
  if (step.observer == nullptr) return;
  for (Object* const object : wanted) show_memory(*object);
}

void PositionReads::read_ghosts(std::span<Object* const> ghosts, const ReadsOfStep& step, TaskPool& tasks,
                                std::vector<Diagnostic>& diagnostics) {
  begin(step);
  make_room(planned_, ghosts.size());
  make_room(found_, ghosts.size());
  for (Object* const object : ghosts) {
    // A ghost is near what is here, so it is never only surveyed.
    add_promise(*object);
    object->end_view();
    object->demand = Demand::nothing;
    object->goes_by_lists = false;
    object->plan = with_blocks_ ? ReadPlan::read_with_blocks : ReadPlan::read;
    object->state = ReadState::read;
    list_planned(*object);
  }
  read_all({}, nanoseconds_of(ghosts.size(), vertices_to_read_), tasks);
  report_problems(diagnostics);
}

/// Decides how an object with input is read. It stays unread if promises allow that.
bool PositionReads::plan(Object& object, Counts& counts) const {
  if (stays_unread(object)) {
    object.state = ReadState::still_surveyed;
    return false;
  }
  add_promise(object);
  object.end_view();
  const bool surveys = can_be_surveyed(object, with_blocks_);
  if (surveys) ++counts.surveyed;
  const Demand demand = std::exchange(object.demand, Demand::nothing);
  object.goes_by_lists = demand == Demand::test;
  if (object.is_unread() && (object.pose || !surveys)) counts.changed = true;
  if (may_stay_unread(object)) {
    leave_unread(object, counts);
    return false;
  }
  if (demand == Demand::blocks)
    object.plan = surveys ? ReadPlan::survey_and_view : ReadPlan::read_with_blocks;
  else
    object.plan = surveys ? ReadPlan::survey : ReadPlan::read;
  // A pose that is refused later leaves the object as it is, read or surveyed.
  // So does one that a step without memory for it has not read.
  if (object.was_surveyed())
    object.state = object.is_posed() ? ReadState::surveyed : ReadState::due;
  else
    object.state = ReadState::read;
  return true;
}

/// Leaves an object unread that promises keep far from everything.
void PositionReads::leave_unread(Object& object, Counts& counts) {
  object.state = ReadState::unread;
  object.box = grown(object.seen.box, object.promises.motion);
  ++counts.unread;
  counts.changed = true;
}

/// Plans how to read an unread object that is near others, or views it at once if it is large.
void PositionReads::plan_late(Object& object) {
  const bool views = with_blocks_ && object.is_surveyed() && can_be_viewed(object);
  if (views && object.in_parts) {
    object.plan = ReadPlan::skip;
    return view_memory(object);
  }
  const bool makes_blocks = with_blocks_ && !object.goes_by_lists;
  object.plan = views ? ReadPlan::view : makes_blocks ? ReadPlan::read_with_blocks : ReadPlan::read;
  list_planned(object);
}

void PositionReads::list_planned(Object& object) {
  vertices_to_read_ += object.mesh->vertex_count();
  if (object.in_parts && !(is_survey(object.plan) && has_known_box(object))) return list_in_parts(object);
  planned_.push_back(&object);
}

void PositionReads::list_in_parts(Object& object) {
  const std::uint32_t count = object.mesh->vertex_count();
  const bool keeps_start = swept_.begin_keeping(object, is_new(object));
  for (std::uint32_t begin = 0; begin < count; begin += vertices_of_part)
    parts_.push_back({&object, begin, std::min(vertices_of_part, count - begin), {}, keeps_start});
  in_parts_.push_back({&object, parts_.size(), keeps_start});
}

/// A task calls it once for many objects.
void PositionReads::add(const Counts& counts) {
  unread_count_.fetch_add(counts.unread, std::memory_order_relaxed);
  surveyed_count_.fetch_add(counts.surveyed, std::memory_order_relaxed);
  vertices_read_.fetch_add(counts.vertices, std::memory_order_relaxed);
  if (counts.changed) changed_.store(true, std::memory_order_relaxed);
}

/// Reads what is planned. Plans and reads the objects in `small`.
void PositionReads::read_all(std::span<Object*> small, double nanoseconds, TaskPool& tasks) {
  // A task writes its own objects, and their own entries of `small` and `found_`. Or it reads its own
  // vertices of a large object and writes its own part. Tasks share only counts.
  const std::size_t listed = planned_.size() + in_parts_.size();
  if (found_.size() < listed + small.size()) found_.resize(listed + small.size());
  const std::size_t of_planned = objects_of_batch(planned_.size());
  const std::size_t of_small = objects_of_batch(small.size());
  const std::size_t planned_end = parts_.size() + batches_of(planned_.size(), of_planned);
  const auto read = [&](unsigned, std::size_t item) {
    if (item < parts_.size()) return read_part(parts_[item]);
    if (item < planned_end) {
      const std::size_t begin = (item - parts_.size()) * of_planned;
      return read_planned(begin, std::min(begin + of_planned, planned_.size()));
    }
    const std::size_t begin = (item - planned_end) * of_small;
    read_small(small, begin, std::min(begin + of_small, small.size()));
  };
  // The lambda is passed by reference, since std::function would allocate for what it captures.
  tasks.run(planned_end + batches_of(small.size(), of_small), std::cref(read), {.nanoseconds = nanoseconds});
  finish_large(tasks);
}

void PositionReads::read_part(Part& part) {
  const AccessScope access({AccessRight::read(), {}});
  if (part.keeps_start)
    part.object->sweep->motion.keep(part.object->surface(), part.begin, part.begin + part.count);
  part.seen = scan_part(*part.object, part.begin, part.begin + part.count);
}

void PositionReads::read_planned(std::size_t begin, std::size_t end) {
  Counts counts;
  for (std::size_t index = begin; index < end; ++index) {
    const AccessScope access({AccessRight::write(planned_[index]), {}});
    read_one(*planned_[index], found_[index], counts);
  }
  add(counts);
}

void PositionReads::read_small(std::span<Object*> small, std::size_t begin, std::size_t end) {
  Counts counts;
  for (std::size_t index = begin; index < end; ++index) {
    if (index + objects_ahead < end) prefetch_range(small[index + objects_ahead], sizeof(Object));
    if (index + 1 < end) prefetch_memory(*small[index + 1]);
    Object& object = *small[index];
    const AccessScope access({AccessRight::write(&object), {}});
    object.may_have_input = has_input(object);
    if (!object.may_have_input) {
      small[index] = nullptr;
      some_dropped_.store(true, std::memory_order_relaxed);
    } else if (plan(object, counts)) {
      if (!was_read_.empty()) was_read_[index] = 1;
      counts.vertices += object.mesh->vertex_count();
      read_one(object, found_[planned_.size() + in_parts_.size() + index], counts);
    }
  }
  add(counts);
}

/// Reads an object as it is planned. Other threads read other objects at the same time.
void PositionReads::read_one(Object& object, std::optional<Problem>& problem, Counts& counts) {
  if (object.sweep != nullptr && swept_.begin_keeping(object, is_new(object))) {
    object.sweep->motion.keep(object.surface(), 0, object.mesh->vertex_count());
    swept_.end_keeping(object);
  }
  ReadOutcome outcome = read_whole(object);
  object.is_unplaced = object.is_unplaced && object.frozen;
  counts.changed = counts.changed || outcome.changed;
  if (outcome.problem) {
    problem = {object.serial, std::move(*outcome.problem)};
    some_problems_.store(true, std::memory_order_relaxed);
  }
  // This comes last, since it may throw for lack of memory.
  const ReadPlan plan = std::exchange(object.plan, ReadPlan::skip);
  if (plan == ReadPlan::read_with_blocks) object.surface_to_write().make_blocks();
  // A survey leaves the surface alone. To count it would bring it from memory.
  if (plan != ReadPlan::survey) bytes_.count(object);
}

/// Shows the observer the memory of an object that was read, where it may be new.
void PositionReads::show_memory(Object& object) const {
  if (object.bound && std::exchange(object.is_unobserved, false)) step_.observer->see_memory(object);
}

void PositionReads::show_what_was_read() const {
  for (std::size_t i = 0; i < was_read_.size(); ++i)
    if (was_read_[i] != 0) show_memory(*small_[i]);
  for (Object* const object : planned_) show_memory(*object);
  for (const LargeObject& large : in_parts_) show_memory(*large.object);
}

/// If there is no memory for them, they stay for the next call.
void PositionReads::report_problems(std::vector<Diagnostic>& diagnostics) {
  if (!some_problems_) return;
  for (std::optional<Problem>& problem : found_) {
    if (!problem) continue;
    problems_.push_back(std::move(*problem));
    problem.reset();
  }
  std::sort(problems_.begin(), problems_.end(),
            [](const Problem& left, const Problem& right) { return left.serial < right.serial; });
  diagnostics.reserve(diagnostics.size() + problems_.size());
  for (Problem& problem : problems_) diagnostics.push_back(std::move(problem.diagnostic));
  problems_.clear();
  some_problems_ = false;
}

/// Accepts the scans of the large objects, and writes the parts of those that changed.
void PositionReads::finish_large(TaskPool& tasks) {
  std::size_t finished = 0;
  std::size_t to_write = 0;
  const auto write_finished = [&] {
    tasks.run(to_write,
              [&](unsigned, std::size_t item) {
                // The last parts come first, since they are still in a cache.
                const Part& part = parts_[to_write - 1 - item];
                const AccessScope access({AccessRight::write(part.object), {}});
                write_part(*part.object, part.begin, part.begin + part.count);
              },
              {.nanoseconds = nanoseconds_each_written * static_cast<double>(to_write * vertices_of_part)});
    for (const LargeObject& large : std::span(in_parts_).first(finished)) {
      finish_read(*large.object, large.accepted);
      bytes_.count(*large.object);
      large.object->plan = ReadPlan::skip;
    }
  };
  try {
    for (; finished < in_parts_.size(); ++finished) finish_parts(finished, to_write);
  } catch (...) {
    write_finished();  // accepted objects have to be written even without memory for the rest
    throw;
  }
  write_finished();
}

/// Accepts the scan of one large object. If it is to be written, its parts are moved to the front of
/// `parts_`, before `to_write`.
void PositionReads::finish_parts(std::size_t index, std::size_t& to_write) {
  auto& [object, end, keeps_start, accepted] = in_parts_[index];
  const std::size_t begin = index == 0 ? 0 : in_parts_[index - 1].end;
  Surface::PartSeen all;
  for (std::size_t part = begin; part < end; ++part) all.add(parts_[part].seen);
  if (keeps_start) swept_.end_keeping(*object);
  ReadOutcome outcome = accept_scan(*object, all);
  object->is_unplaced = object->is_unplaced && object->frozen;
  if (object->plan == ReadPlan::survey_and_view && !object->frozen) view_memory(*object);
  accepted = outcome.accepted;
  if (outcome.changed) changed_ = true;
  if (outcome.problem) {
    found_[planned_.size() + index] = {object->serial, std::move(*outcome.problem)};
    some_problems_ = true;
  }
  if (!outcome.to_write) return;
  for (std::size_t part = begin; part < end; ++part) parts_[to_write++] = parts_[part];
}

std::size_t PositionReads::byte_count() const {
  return bytes_of(small_) + bytes_of(large_) + bytes_of(planned_) + bytes_of(in_parts_) + bytes_of(parts_) +
         bytes_of(was_read_) + bytes_of(found_) + bytes_of(problems_);
}

}  // namespace graze
