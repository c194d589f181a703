#pragma once

#include <cstdint>
#include <graze/surface.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "staging.hpp"
#include "task_pool.hpp"

namespace graze {

/// One object of a scene as the steps see it.
struct Object {
  ObjectId id;
  std::uint64_t serial = 0;  ///< the order in which objects were added; never used again
  ObjectSettings settings;
  std::unique_ptr<Surface> surface;
  /// Where it certainly is: the surface's box, grown by what was promised since that was read.
  Box box;
  /// Bound memory was bad when last read: the object stands where it was, and its pairs are not looked at.
  bool frozen = false;

  // What the next read takes up, and what is promised of it.
  std::optional<std::array<double, 12>> pose;
  std::optional<std::vector<Eigen::Vector3d>> positions;
  std::optional<PositionView> bound;
  BindPolicy policy = BindPolicy::every_step;
  bool told = false;
  bool is_new = false;  ///< given since the last step
  double promise = std::numeric_limits<double>::infinity();
  /// There are positions that have not been read, since promises say that they are far from everything.
  bool unread = false;
  /// No vertex is further from where the surface has it, by the promises since that was read.
  double promised = 0;
};

/// The objects of a scene in the order in which they were added. Stepping thread only.
class ObjectStore {
 public:
  void apply(AddObject& command);
  /// Whether there was such an object.
  void apply(const RemoveObject& command);
  void apply(const SetPose& command);
  void apply(SetPositions& command);
  void apply(const BindPositions& command);
  void apply(const UnbindPositions& command);
  void apply(const PositionsChanged& command);

  /// Brings every object to where it is now, but for those of which promises say about where they are. Reads
  /// each object's memory at most once, several objects at a time; appends what was wrong in the objects'
  /// order.
  void read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics);
  /// Reads those of `wanted` that have not been read; may name objects several times.
  void read_unread(std::vector<Object*>& wanted, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);

  [[nodiscard]] std::span<const std::unique_ptr<Object>> objects() const { return objects_; }
  [[nodiscard]] Object* find(ObjectId id);

 private:
  void read(std::span<Object* const> objects, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);

  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<Object*> by_index_;
  std::vector<Object*> to_read_;
  std::vector<std::optional<Diagnostic>> read_problems_;
  std::uint64_t next_serial_ = 0;
};

}  // namespace graze
