#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "calls/staging.hpp"
#include "ignored.hpp"
#include "messages.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze::cluster {

/// The ghosts of a rank: the objects of other ranks that its scene has, each where its own rank has read it
/// in the same step. Stepping thread only.
class Ghosts {
 public:
  Ghosts(Staging& staging, int rank) : staging_(staging), rank_(rank) {}

  /// Begins a step.
  void begin_step() { gone_.clear(); }
  /// Takes up what a rank tells about its objects. Those that move are read by `read`.
  void hear(int from, std::span<const std::byte> message, ObjectStore& store, PairFilter& filter);
  /// Reads all ghosts of which something was heard in this step.
  void read(ObjectStore& store, PairFilter& filter, const Ignored& ignored, TaskPool& tasks);
  /// Adds objects that another rank has owned, and that this one owns from now on. They stand where they were
  /// seen last. Returns them.
  std::vector<Object*> take_over(std::span<const MovingObject> moving,
                                 std::span<const std::shared_ptr<const Mesh>> meshes, ObjectStore& store,
                                 TaskPool& tasks);
  /// Takes a ghost out.
  void drop(Number number, ObjectStore& store, PairFilter& filter);

  [[nodiscard]] bool has(Number number) const { return ghosts_.contains(number); }
  [[nodiscard]] std::size_t count() const { return ghosts_.size(); }
  /// The rank that owns a ghost, also of one that was dropped in this step. -1 of all other objects.
  [[nodiscard]] int rank_of(Number number) const;
  [[nodiscard]] bool some_of(int rank) const;

 private:
  struct Ghost {
    ObjectId id;
    int from = 0;
    Object* object = nullptr;
  };

  void arrive(int from, const GhostState& state, const GhostArrival& arrival, ObjectStore& store);
  void replace(const GhostState& state, const GhostMesh& news, int from, ObjectStore& store,
               PairFilter& filter);
  void move(Object& object, const std::optional<std::array<double, 12>>& pose, const PositionView& positions,
            const Box& box);
  [[nodiscard]] std::shared_ptr<const Mesh> mesh_of(int from, std::uint64_t number) const;

  Staging& staging_;
  int rank_;
  std::map<Number, Ghost> ghosts_;
  std::map<int, std::size_t> counts_;  ///< by their ranks
  std::map<Number, int> gone_;         ///< the ranks of those that were dropped in this step
  std::map<std::pair<int, std::uint64_t>, std::weak_ptr<const Mesh>> meshes_;
  std::vector<std::shared_ptr<const Mesh>> new_meshes_;  ///< of this step, until a ghost has them
  std::vector<Object*> new_;                             ///< that have come, and do not move in this step
  std::vector<Object*> starts_;  ///< that stand where they were before this step, and are to be read there
  bool some_seen_ = false;       ///< an earlier step has seen one that has come
  std::vector<GhostState> states_;
  std::vector<Number> arrived_;
};

/// How an object stands in the current step.
[[nodiscard]] GhostState state_of(const Object& object, const ObjectStore& store);

/// Tells other ranks of the objects that they have as ghosts. Stepping thread only.
class GhostSender {
 public:
  /// The state of an object as a rank was told it last.
  struct Told {
    std::uint64_t version = 0;
    std::uint64_t mesh_number = 0;
    std::uint64_t mesh = 0;
    std::optional<std::array<double, 12>> pose;
    bool frozen = false;
    bool is_unplaced = false;
  };

  /// Whether a rank has ghosts of this one.
  [[nodiscard]] bool some_at(int rank) const;
  /// Writes the news for a rank. Its ghosts are to be `wanted`, which are objects of this rank.
  /// `last_poses` says where posed objects stood in the last step, if they are in swept pairs.
  void tell(int rank, std::span<Object* const> wanted, const ObjectStore& store,
            const std::map<Number, std::array<double, 12>>& last_poses, ByteBuffer& message);
  /// The objects that a rank has as ghosts.
  [[nodiscard]] std::vector<Number> ghosts_at(int rank) const;
  /// Forgets that other ranks know an object, since each of them drops it.
  void forget(Number number);
  /// How many bytes of meshes and settings were written since the last call.
  [[nodiscard]] std::uint64_t take_mesh_bytes() { return std::exchange(mesh_bytes_, 0); }

 private:
  struct Receiver {
    std::map<Number, Told> told;
    std::map<std::uint64_t, std::size_t> meshes;  ///< how many of its ghosts have each mesh
  };
  struct Known {
    std::uint64_t number = 0;
    std::weak_ptr<const IndexedMesh> mesh;  ///< another mesh may come to lie where this one was
  };

  [[nodiscard]] std::uint64_t number_of(const std::shared_ptr<const IndexedMesh>& mesh);
  std::uint64_t tell_mesh(Receiver& receiver, const Object& object, ByteBuffer& message);

  std::map<int, Receiver> receivers_;
  std::map<const IndexedMesh*, Known> meshes_;
  std::uint64_t mesh_count_ = 0;
  std::size_t meshes_kept_ = 0;  ///< when the expired ones were dropped last
  std::uint64_t mesh_bytes_ = 0;
};

}  // namespace graze::cluster
