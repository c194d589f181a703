#include <algorithm>
#include <cstring>
#include <utility>

#include "ghosts.hpp"
#include "recording/chunks.hpp"

namespace graze::cluster {
namespace {

/// The settings of a ghost. It is not tested against itself, since its own rank does that.
ObjectSettings settings_of_ghost(const ObjectSettings& own) {
  ObjectSettings settings = own;
  settings.self = false;
  return settings;
}

bool jumps(const Object& object, const ObjectStore& store) {
  return object.sweep != nullptr && object.sweep->jumps_step == store.swept().step();
}

}  // namespace

GhostState state_of(const Object& object, const ObjectStore& store) {
  GhostState state;
  state.number = object.serial;
  state.box = numbers_of(object.box);
  if (object.is_posed())
    state.pose = object.standing_pose;
  else
    state.positions = object.surface().positions();
  state.frozen = object.frozen;
  state.is_unplaced = object.is_unplaced;
  state.jumps = jumps(object, store);
  return state;
}

namespace {

/// Poses are compared by their bits.
bool are_same(const std::optional<std::array<double, 12>>& one,
              const std::optional<std::array<double, 12>>& other) {
  if (one.has_value() != other.has_value()) return false;
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return !one || std::memcmp(one->data(), other->data(), sizeof(*one)) == 0;
}

GhostSender::Told told_of(const Object& object) {
  GhostSender::Told told;
  told.version = object.is_posed() ? 0 : object.surface().version();
  told.mesh_number = object.mesh_number;
  told.pose = object.standing_pose;
  told.frozen = object.frozen;
  told.is_unplaced = object.is_unplaced;
  return told;
}

bool are_same(const GhostSender::Told& one, const GhostSender::Told& other) {
  return one.version == other.version && one.frozen == other.frozen && one.is_unplaced == other.is_unplaced &&
         are_same(one.pose, other.pose);
}

}  // namespace

bool GhostSender::some_at(int rank) const {
  const auto found = receivers_.find(rank);
  return found != receivers_.end() && !found->second.told.empty();
}

std::vector<Number> GhostSender::ghosts_at(int rank) const {
  std::vector<Number> all;
  if (const auto found = receivers_.find(rank); found != receivers_.end())
    for (const auto& [number, told] : found->second.told) all.push_back(number);
  return all;
}

void GhostSender::forget(Number number) {
  for (auto& [rank, receiver] : receivers_)
    if (const auto found = receiver.told.find(number); found != receiver.told.end()) {
      --receiver.meshes[found->second.mesh];
      receiver.told.erase(found);
    }
}

std::uint64_t GhostSender::number_of(const std::shared_ptr<const IndexedMesh>& mesh) {
  Known& known = meshes_[mesh.get()];
  if (known.mesh.lock() == mesh) return known.number;
  known = {++mesh_count_, mesh};
  const std::uint64_t number = known.number;
  if (meshes_.size() > 2 * meshes_kept_ + 64) {
    std::erase_if(meshes_, [](const auto& each) { return each.second.mesh.expired(); });
    meshes_kept_ = meshes_.size();
  }
  return number;
}

/// Writes the mesh of an object, unless a ghost of the receiver has it.
std::uint64_t GhostSender::tell_mesh(Receiver& receiver, const Object& object, ByteBuffer& message) {
  const std::shared_ptr<const IndexedMesh>& mesh = object.surface().shared_mesh();
  const std::uint64_t number = number_of(mesh);
  if (receiver.meshes[number]++ > 0) return number;
  const std::size_t before = message.size();
  write_fields(message, GhostNews::mesh, number);
  write_fields(message, mesh_chunk_of(*mesh));
  mesh_bytes_ += message.size() - before;
  return number;
}

void GhostSender::tell(int rank, std::span<Object* const> wanted, const ObjectStore& store,
                       const std::map<Number, std::array<double, 12>>& last_poses, ByteBuffer& message) {
  Receiver& receiver = receivers_[rank];
  std::map<Number, Told> told;
  for (const Object* const object : wanted) {
    const auto before = receiver.told.find(object->serial);
    Told now = told_of(*object);
    if (before == receiver.told.end()) {
      now.mesh = tell_mesh(receiver, *object, message);
      GhostArrival arrival{now.mesh, settings_of_ghost(object->settings), false, {}, {}};
      if (store.swept().moves(*object)) {
        arrival.was_seen = true;
        if (const auto last = last_poses.find(object->serial); last != last_poses.end())
          arrival.start = last->second;
        if (!object->is_posed())
          arrival.start_positions = PositionView(object->sweep->motion.way(object->surface(), true).start);
      }
      const std::size_t size = message.size();
      write_fields(message, GhostNews::arrival, state_of(*object, store), arrival);
      mesh_bytes_ += message.size() - size;
    } else {
      now.mesh = before->second.mesh;
      if (now.mesh_number != before->second.mesh_number) {
        --receiver.meshes[now.mesh];
        now.mesh = tell_mesh(receiver, *object, message);
        write_fields(message, GhostNews::replacement, state_of(*object, store),
                     GhostMesh{now.mesh, object->replaced->new_of_old, object->settings.face_groups});
      } else if (!are_same(now, before->second) || jumps(*object, store)) {
        write_fields(message, GhostNews::state, state_of(*object, store));
      }
      receiver.told.erase(before);
    }
    told.emplace_hint(told.end(), object->serial, now);
  }
  for (const auto& [number, last] : receiver.told) {
    write_fields(message, GhostNews::departure, number);
    --receiver.meshes[last.mesh];
  }
  receiver.told = std::move(told);
  std::erase_if(receiver.meshes, [](const auto& mesh) { return mesh.second == 0; });
  write_fields(message, GhostNews::end);
}

}  // namespace graze::cluster
