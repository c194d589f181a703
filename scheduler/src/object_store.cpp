#include "object_store.hpp"

#include <algorithm>
#include <utility>

#include "object_name.hpp"

namespace graze {
namespace {

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
  if (!(result.displacement > object.promise * (1 + 0x1p-50))) return std::nullopt;
  return Diagnostic{object.id, DiagnosticKind::broken_promise,
                    name_of(object.id, object) + ": a vertex moved by " +
                        std::to_string(result.displacement) + ", further than the " +
                        std::to_string(object.promise) + " promised; all positions were read"};
}

std::optional<Diagnostic> read_bound(Object& object) {
  if (object.policy == BindPolicy::when_told && !object.told) return std::nullopt;
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
  object.promise = std::numeric_limits<double>::infinity();
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
  object->promise = command.max_displacement;
}

void ObjectStore::apply(const BindPositions& command) {
  Object* const object = find(command.object);
  if (object == nullptr) return;
  object->positions.reset();
  object->bound = command.view;
  object->policy = command.policy;
  object->told = true;
  object->promise = std::numeric_limits<double>::infinity();
}

void ObjectStore::apply(const UnbindPositions& command) {
  Object* const object = find(command.object);
  if (object == nullptr) return;
  object->bound.reset();
  object->frozen = false;
}

void ObjectStore::apply(const PositionsChanged& command) {
  Object* const object = find(command.object);
  if (object == nullptr || !object->bound) return;
  object->told = true;
  object->promise = command.max_displacement;
}

void ObjectStore::read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  read_problems_.assign(objects_.size(), std::nullopt);
  // A task writes its own objects and their own places in read_problems_; nothing is shared.
  tasks.run(objects_.size(),
            [&](unsigned, std::size_t index) { read_problems_[index] = read_object(*objects_[index]); });
  for (std::optional<Diagnostic>& problem : read_problems_)
    if (problem) diagnostics.push_back(std::move(*problem));
}

}  // namespace graze
