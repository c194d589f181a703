#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <graze/cluster/transport.hpp>
#include <graze/object_id.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/base/box.hpp"
#include "objects/filter_traits.hpp"
#include "objects/object.hpp"
#include "recording/archive.hpp"
#include "recording/byte_buffer.hpp"
#include "recording/chunks.hpp"
#include "recording/records.hpp"

// The messages of ranks. Objects are named by their numbers, which are Object::serial.

namespace graze::cluster {

using Number = std::uint64_t;

/// The id by which callers know an object of that number.
inline ObjectId id_of(Number number) {
  return {static_cast<std::uint32_t>(number), 1};
}

/// A rank tells it to all others before it reads in a step.
struct StepNote {
  std::uint64_t settings_hash = 0;  ///< of what all have alike
  std::uint64_t stepped = 0;        ///< frames so far, to find out that ranks do not step together
  std::uint32_t swept_layers = 0;   ///< the layers of all objects that are swept and were added there
  std::uint32_t swept_masks = 0;
  bool some_swept = false;
};

/// A rank tells it to all others when it has read.
struct RankNote {
  std::array<double, 6> extent{};   ///< the box of all boxes of objects that the rank owns. It may be empty
  std::array<double, 6> objects{};  ///< the box of the objects themselves
  std::uint64_t load = 0;           ///< of the last step, in nanoseconds
  std::vector<Number> removed;      ///< objects that are gone for good
};

/// An object near a rank, as that rank knows it before it has to have more.
struct NearObject {
  Number number = 0;
  std::array<double, 6> box{};  ///< with half of what pairs may be apart on each side, and room to move
  std::uint64_t group = 0;
  std::uint32_t layer = 0;
  std::uint32_t collides_with = 0;
  bool is_fixed = false;
};

/// How an object stands in its step, for the ranks that have it as a ghost.
struct GhostState {
  Number number = 0;
  std::array<double, 6> box{};
  std::optional<std::array<double, 12>> pose;  ///< of a rigid or fixed object that was placed
  PositionView positions;                      ///< of a deformable one. Of size 0 otherwise
  bool frozen = false;
  bool is_unplaced = false;
  bool jumps = false;
};

/// An object that a rank gets as a ghost.
struct GhostArrival {
  std::uint64_t mesh = 0;  ///< the number of a mesh that the rank has sent
  ObjectSettings settings;
  bool was_seen = false;                        ///< an earlier step has seen it, where it was before
  std::optional<std::array<double, 12>> start;  ///< that place, as that of GhostState
  PositionView start_positions;
};

/// Another mesh of an object that is a ghost.
struct GhostMesh {
  std::uint64_t mesh = 0;
  std::vector<std::uint32_t> new_of_old;
  std::vector<std::uint8_t> face_groups;
};

/// An object that goes to another rank, with where it stands.
struct MovingObject {
  GhostState state;
  ObjectSettings settings;
  std::uint64_t mesh = 0;  ///< among those of the message
};

/// A row of the last report of which an object goes to another rank, with the ranks that its objects have
/// then.
struct MovingRow {
  int rank_of_a = 0;
  int rank_of_b = 0;
};

/// An object that goes to another rank, as all ranks know of it.
struct Move {
  Number number = 0;
  int to = 0;
};

/// The kinds of news in a message about ghosts.
enum class GhostNews : std::uint8_t { end, mesh, arrival, replacement, state, departure };

}  // namespace graze::cluster

namespace graze {

template <>
inline constexpr std::uint8_t last_of<cluster::GhostNews> = underlying(cluster::GhostNews::departure);

}  // namespace graze

namespace graze::cluster {

template <Is<StepNote> T>
auto fields(T& r) {
  return std::tie(r.settings_hash, r.stepped, r.swept_layers, r.swept_masks, r.some_swept);
}
template <Is<RankNote> T>
auto fields(T& r) {
  return std::tie(r.extent, r.objects, r.load, r.removed);
}
template <Is<NearObject> T>
auto fields(T& r) {
  return std::tie(r.number, r.box, r.group, r.layer, r.collides_with, r.is_fixed);
}
template <Is<GhostState> T>
auto fields(T& r) {
  return std::tie(r.number, r.box, r.pose, r.positions, r.frozen, r.is_unplaced, r.jumps);
}
template <Is<GhostArrival> T>
auto fields(T& r) {
  return std::tie(r.mesh, r.settings, r.was_seen, r.start, r.start_positions);
}
template <Is<MovingObject> T>
auto fields(T& r) {
  return std::tie(r.state, r.settings, r.mesh);
}
template <Is<MovingRow> T>
auto fields(T& r) {
  return std::tie(r.rank_of_a, r.rank_of_b);
}
template <Is<Move> T>
auto fields(T& r) {
  return std::tie(r.number, r.to);
}
template <Is<GhostMesh> T>
auto fields(T& r) {
  return std::tie(r.mesh, r.new_of_old, r.face_groups);
}

inline std::array<double, 6> numbers_of(const Box& box) {
  return {box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()};
}
inline Box box_of(const std::array<double, 6>& numbers) {
  Box box;
  box.min = {numbers[0], numbers[1], numbers[2]};
  box.max = {numbers[3], numbers[4], numbers[5]};
  return box;
}

}  // namespace graze::cluster
