#include "ghosts.hpp"

#include <graze/error.hpp>
#include <limits>
#include <string>
#include <utility>

#include "borders.hpp"
#include "core/mesh/face_groups.hpp"
#include "objects/object_reading.hpp"
#include "recording/chunks.hpp"

namespace graze::cluster {

int Ghosts::rank_of(Number number) const {
  if (const auto found = ghosts_.find(number); found != ghosts_.end()) return found->second.from;
  const auto gone = gone_.find(number);
  return gone == gone_.end() ? -1 : gone->second;
}

bool Ghosts::some_of(int rank) const {
  const auto found = counts_.find(rank);
  return found != counts_.end() && found->second > 0;
}

std::shared_ptr<const Mesh> Ghosts::mesh_of(int from, std::uint64_t number) const {
  const auto found = meshes_.find({from, number});
  std::shared_ptr<const Mesh> mesh = found == meshes_.end() ? nullptr : found->second.lock();
  if (mesh == nullptr) throw Error("a ghost names a mesh that was not sent");
  return mesh;
}

/// Takes a copy of positions that stay in the message.
void Ghosts::move(Object& object, const std::optional<std::array<double, 12>>& pose,
                  const PositionView& positions, const Box& box) {
  if (pose) object.pose = *pose;
  if (positions.size() == 0) return;
  object.positions = staging_.copy_for_ghost(object.id, positions);
  object.box_of_positions = box;
  object.promises.next = Promises::any_distance;
}

void Ghosts::arrive(int from, const GhostState& state, const GhostArrival& arrival, ObjectStore& store) {
  if (has(state.number) || store.find_serial(state.number) != nullptr)
    throw Error("two ranks own an object of number " + std::to_string(state.number));
  AddObject call = addition_of(mesh_of(from, arrival.mesh), arrival.settings);
  call.serial = state.number;
  call.place = place_of_ghost(state.number, from, rank_);
  Ghost ghost{staging_.name_ghost(call), from, nullptr};
  call.object = ghost.id;
  store.apply(call);
  ghost.object = store.find(ghost.id);
  ghosts_.emplace(state.number, ghost);
  ++counts_[from];
  arrived_.push_back(state.number);
  if (!arrival.was_seen) return new_.push_back(ghost.object);
  Box box;
  for (std::size_t vertex = 0; vertex < arrival.start_positions.size(); ++vertex)
    box.add(arrival.start_positions[vertex]);
  move(*ghost.object, arrival.start, arrival.start_positions, box);
  some_seen_ = true;
  if (has_input(*ghost.object)) starts_.push_back(ghost.object);
}

std::vector<Object*> Ghosts::take_over(std::span<const MovingObject> moving,
                                       std::span<const std::shared_ptr<const Mesh>> meshes,
                                       ObjectStore& store, TaskPool& tasks) {
  std::vector<Object*> objects;
  for (const MovingObject& each : moving) {
    AddObject call = addition_of(meshes[each.mesh], each.settings);
    call.serial = each.state.number;
    call.place = place_of_own(each.state.number);
    const ObjectId id = call.object = staging_.name_ghost(call);
    store.apply(call);
    objects.push_back(store.find(id));
  }
  store.sort_ghosts();
  std::vector<Object*> moved;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const GhostState& state = moving[i].state;
    move(*objects[i], state.pose, state.positions, box_of(state.box));
    if (has_input(*objects[i])) moved.push_back(objects[i]);
  }
  std::vector<Diagnostic> none;
  store.read_ghosts(moved, tasks, none);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i]->sweep != nullptr) objects[i]->sweep->kept_step = 0;
    objects[i]->frozen = moving[i].state.frozen;
    objects[i]->is_unplaced = moving[i].state.is_unplaced;
  }
  return objects;
}

void Ghosts::replace(const GhostState& state, const GhostMesh& news, int from, ObjectStore& store,
                     PairFilter& filter) {
  const Ghost& ghost = ghosts_.at(state.number);
  ObjectSettings settings = ghost.object->settings;
  settings.face_groups = news.face_groups;
  AddObject made = addition_of(mesh_of(from, news.mesh), settings);
  filter.regroup(*ghost.object, made.face_groups);
  ReplaceMesh call{ghost.id, std::move(made.surface), news.new_of_old, news.face_groups, made.face_groups,
                   nullptr,  std::move(made.mesh)};
  store.apply(call);
}

void Ghosts::drop(Number number, ObjectStore& store, PairFilter& filter) {
  const auto found = ghosts_.find(number);
  const Ghost ghost = found->second;
  filter.forget(*ghost.object);
  store.apply(RemoveObject{ghost.id});
  staging_.forget_ghost(ghost.id);
  --counts_[ghost.from];
  gone_.emplace(number, ghost.from);
  ghosts_.erase(found);
}

void Ghosts::hear(int from, std::span<const std::byte> message, ObjectStore& store, PairFilter& filter) {
  ByteSource source(message);
  GhostNews next{};
  for (source(next); next != GhostNews::end; source(next)) {
    if (next == GhostNews::mesh) {
      std::uint64_t number = 0;
      source(number);
      new_meshes_.push_back(read_mesh(source));
      meshes_[{from, number}] = new_meshes_.back();
      continue;
    }
    if (next == GhostNews::departure) {
      Number number = 0;
      source(number);
      drop(number, store, filter);
      continue;
    }
    GhostState state;
    source(state);
    if (next == GhostNews::arrival) {
      GhostArrival arrival;
      source(arrival);
      arrive(from, state, arrival, store);
    } else if (next == GhostNews::replacement) {
      GhostMesh mesh;
      source(mesh);
      replace(state, mesh, from, store, filter);
    }
    states_.push_back(state);
  }
}

/// Reads twice: first where objects that have come were before this step, since sweeps begin there.
void Ghosts::read(ObjectStore& store, PairFilter& filter, const Ignored& ignored, TaskPool& tasks) {
  std::vector<Diagnostic> none;
  store.sort_ghosts();
  if (std::exchange(some_seen_, false)) store.read_ghosts(starts_, tasks, none);
  std::vector<Object*> moved;
  for (const GhostState& state : states_) {
    Object& object = *ghosts_.at(state.number).object;
    object.frozen = false;
    if (state.jumps && object.sweep != nullptr) object.sweep->jumps_step = store.swept().step();
    move(object, state.pose, state.positions, box_of(state.box));
    if (has_input(object)) moved.push_back(&object);
  }
  store.read_ghosts(moved, tasks, none);
  // The first read takes all that have come for seen. New ones are not, so they stand in this step.
  for (Object* const object : new_)
    if (object->sweep != nullptr) object->sweep->kept_step = 0;
  for (const GhostState& state : states_) {
    Object& object = *ghosts_.at(state.number).object;
    object.frozen = state.frozen;
    object.is_unplaced = state.is_unplaced;
  }
  for (const Number number : arrived_) ignored.apply_to(number, store, filter);
  new_.clear();
  starts_.clear();
  states_.clear();
  arrived_.clear();
  new_meshes_.clear();
  std::erase_if(meshes_, [](const auto& each) { return each.second.expired(); });
}

}  // namespace graze::cluster
