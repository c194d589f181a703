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
  /// Bound memory was bad when last read: the object stands where it was, and its pairs are not looked at.
  bool frozen = false;

  // What the next read takes up.
  std::optional<std::array<double, 12>> pose;
  std::optional<std::vector<Eigen::Vector3d>> positions;
  std::optional<PositionView> bound;
  BindPolicy policy = BindPolicy::every_step;
  bool told = false;
  double promise = std::numeric_limits<double>::infinity();
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

  /// Brings every object to where it is now. Reads each object's memory once, several objects at a time;
  /// appends what was wrong in the objects' order.
  void read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics);

  [[nodiscard]] std::span<const std::unique_ptr<Object>> objects() const { return objects_; }
  [[nodiscard]] Object* find(ObjectId id);

 private:
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<Object*> by_index_;
  std::vector<std::optional<Diagnostic>> read_problems_;
  std::uint64_t next_serial_ = 0;
};

}  // namespace graze
