#include "object_store.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
  std::string text = std::to_string(point.x());
  text.append(", ").append(std::to_string(point.y())).append(", ").append(std::to_string(point.z()));
  return text;
}

Diagnostic bad_vertex(const Object& object, const Surface::ReadResult& result, const char* consequence) {
  const bool finite = result.bad_position.allFinite();
  return {object.id, finite ? DiagnosticKind::too_large : DiagnosticKind::not_finite,
          name_of(object.id, object) + ": vertex " + std::to_string(result.bad_vertex) + " is at " +
              coordinates(result.bad_position) + (finite ? ", beyond 2^120" : "") + "; " + consequence};
}

std::optional<Diagnostic> check_promise(const Object& object, const Surface::ReadResult& result) {
  // The displacement is rounded; a promise kept to the last bit is not called broken.
  if (!(result.displacement > object.promised * round_up)) return std::nullopt;
  return Diagnostic{object.id, DiagnosticKind::broken_promise,
                    name_of(object.id, object) + ": a vertex moved by " +
                        std::to_string(result.displacement) + ", further than the " +
                        std::to_string(object.promised) + " promised; all positions were read"};
}

/// Whether there are positions or a pose to be read.
bool has_input(const Object& object) {
  return object.positions || object.pose ||
         (object.bound && (object.policy == BindPolicy::every_step || object.told));
}

/// Adds up what is promised of the motion since the surface's positions were read, this step's included.
void add_promise(Object& object) {
  const bool read_in_every_step = object.bound && object.policy == BindPolicy::every_step;
  const bool may_have_moved = read_in_every_step || object.is_new;
  if (may_have_moved) object.promised = (object.promised + object.promise) * round_up;
  object.is_new = false;
  object.promise = std::numeric_limits<double>::infinity();
}

std::optional<Diagnostic> read_bound(Object& object) {
  if (!has_input(object)) return std::nullopt;
  const Surface::ReadResult result = object.surface->set_positions(*object.bound);
  object.frozen = !result.taken();
  if (object.frozen) return bad_vertex(object, result, "it stands still until good positions are read");
  object.told = false;
  return check_promise(object, result);
}

std::optional<Diagnostic> read_object(Object& object) {
  std::optional<Diagnostic> problem;
  if (object.positions) {
    problem = check_promise(object, object.surface->set_positions(*object.positions));
    object.positions.reset();
    object.frozen = false;
  } else if (object.bound) {
    problem = read_bound(object);
  } else if (object.pose) {
    const Surface::ReadResult result = object.surface->set_pose(*object.pose);
    if (!result.taken()) problem = bad_vertex(object, result, "the pose was not taken");
    object.pose.reset();
  }
  if (object.frozen) return problem;
  object.unread = false;
  object.promised = 0;
  object.box = object.surface->box();
  return problem;
}

}  // namespace

Object* ObjectStore::find(ObjectId id) {
  if (id.index >= by_index_.size() || by_index_[id.index] == nullptr) return nullptr;
  Object* const object = by_index_[id.index];
  return object->id == id ? object : nullptr;
}

void ObjectStore::apply(AddObject& command) {
  auto object = std::make_unique<Object>();
  object->id = command.object;
  object->serial = next_serial_++;
  object->settings = std::move(command.settings);
  object->surface = std::move(command.surface);
  object->box = object->surface->box();
  if (by_index_.size() <= command.object.index)
    by_index_.resize(command.object.index + std::size_t{1}, nullptr);
  by_index_[command.object.index] = object.get();
  objects_.push_back(std::move(object));
}

void ObjectStore::apply(const RemoveObject& command) {
  const Object* const object = find(command.object);
  if (object == nullptr) return;
  by_index_[command.object.index] = nullptr;
  std::erase_if(objects_, [&](const std::unique_ptr<Object>& other) { return other.get() == object; });
}

void ObjectStore::apply(const SetPose& command) {
  if (Object* const object = find(command.object)) object->pose = command.rows;
}

void ObjectStore::apply(SetPositions& command) {
  Object* const object = find(command.object);
  if (object == nullptr) return;
  object->bound.reset();
  object->positions = std::move(command.positions);
  object->is_new = true;
  object->promise = command.max_displacement;
}

void ObjectStore::apply(const BindPositions& command) {
  Object* const object = find(command.object);
  if (object == nullptr) return;
  object->positions.reset();
  object->bound = command.view;
  object->policy = command.policy;
  object->told = true;
  object->is_new = true;
  object->promise = std::numeric_limits<double>::infinity();
}

void ObjectStore::apply(const UnbindPositions& command) {
  Object* const object = find(command.object);
  if (object == nullptr) return;
  object->bound.reset();
  object->frozen = false;
  object->unread = false;
  object->promised = 0;
  object->box = object->surface->box();
}

void ObjectStore::apply(const PositionsChanged& command) {
  Object* const object = find(command.object);
  if (object == nullptr || !object->bound) return;
  object->told = true;
  object->is_new = true;
  object->promise = command.max_displacement;
}

void ObjectStore::read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  to_read_.clear();
  for (const auto& object : objects_) {
    add_promise(*object);
    object->unread = !checks_every_promise && has_input(*object) && !object->pose && !object->frozen &&
                     std::isfinite(object->promised);
    if (object->unread)
      object->box = grown(object->surface->box(), object->promised);
    else
      to_read_.push_back(object.get());
  }
  read(to_read_, tasks, diagnostics);
}

void ObjectStore::read_unread(std::vector<Object*>& wanted, TaskPool& tasks,
                              std::vector<Diagnostic>& diagnostics) {
  std::erase_if(wanted, [](const Object* object) { return !object->unread; });
  std::sort(wanted.begin(), wanted.end(),
            [](const Object* left, const Object* right) { return left->serial < right->serial; });
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  read(wanted, tasks, diagnostics);
}

void ObjectStore::read(std::span<Object* const> objects, TaskPool& tasks,
                       std::vector<Diagnostic>& diagnostics) {
  read_problems_.assign(objects.size(), std::nullopt);
  // A task writes its own objects and their own places in read_problems_; nothing is shared.
  tasks.run(objects.size(),
            [&](unsigned, std::size_t index) { read_problems_[index] = read_object(*objects[index]); });
  for (std::optional<Diagnostic>& problem : read_problems_)
    if (problem) diagnostics.push_back(std::move(*problem));
}

}  // namespace graze
