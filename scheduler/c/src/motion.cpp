#include <array>
#include <vector>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "positions.hpp"

// Calls that move objects. Those for many objects take room for their views, but not for a few.

using graze::ObjectId;
using graze::PositionView;
using graze::c::array;
using graze::c::guarded;
using graze::c::same;
using graze::c::scene_of;

namespace {

std::span<const ObjectId> ids_of(const graze_id* objects, std::size_t count) {
  return {graze::c::cpp_rows(array(objects, count, "objects").data()), count};
}

/// An array of the C++ interface, made of a caller's array. Up to four elements need no memory.
template <typename Made>
class Few {
 public:
  /// Makes each of `count` from `step` elements of the caller's.
  template <typename Given, typename Make>
  Few(const Given* given, std::size_t count, const char* name, std::size_t step, const Make& make) {
    static_cast<void>(array(given, count, name));
    if (count > few_.size()) many_.resize(count);
    const std::span<Made> room =
        count > few_.size() ? std::span<Made>(many_) : std::span<Made>(few_).first(count);
    for (Made& each : room) {
      make(given, each);
      given += step;
    }
    all_ = room;
  }
  Few(const Few&) = delete;
  Few& operator=(const Few&) = delete;
  ~Few() = default;

  [[nodiscard]] std::span<const Made> all() const { return all_; }

 private:
  std::array<Made, 4> few_;
  std::vector<Made> many_;
  std::span<const Made> all_;
};

/// The views of a caller's positions.
class Views : public Few<PositionView> {
 public:
  Views(const graze_positions* positions, std::size_t count)
      : Few(positions, count, "positions", 1,
            [](const graze_positions* from, PositionView& view) { view = graze::c::view_of(*from); }) {}
};

void set_poses(graze_scene* scene, const graze_id* objects, std::span<const Eigen::Isometry3d> poses,
               bool jump) {
  const auto ids = ids_of(objects, poses.size());
  if (jump)
    scene_of(scene).set_poses(ids, poses, graze::teleport);
  else
    scene_of(scene).set_poses(ids, poses);
}

}  // namespace

extern "C" {

graze_status graze_scene_set_poses(graze_scene* scene, const graze_id* objects, size_t count,
                                   const double* rows, bool teleport) {
  return guarded([&] {
    const Few<Eigen::Isometry3d> poses(
        rows, count, "rows", 12, [](const double* from, Eigen::Isometry3d& pose) {
          pose.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(from);
          pose.makeAffine();
        });
    set_poses(scene, objects, poses.all(), teleport);
  });
}

graze_status graze_scene_set_pose_matrices(graze_scene* scene, const graze_id* objects, size_t count,
                                           const double* rows) {
  return guarded([&] {
    graze::Scene& moved = scene_of(scene);
    static_cast<void>(array(rows, count, "rows"));
    for (const ObjectId id : ids_of(objects, count)) {
      std::array<double, 16> matrix{};
      std::copy_n(rows, matrix.size(), matrix.data());
      moved.set_pose_matrix(id, matrix);
      rows += matrix.size();
    }
  });
}

graze_status graze_scene_set_positions(graze_scene* scene, const graze_id* objects, size_t count,
                                       const graze_positions* positions, double max_displacement) {
  return guarded([&] {
    const Views views(positions, count);
    scene_of(scene).set_positions(ids_of(objects, count), views.all(), max_displacement);
  });
}

graze_status graze_scene_teleport_positions(graze_scene* scene, const graze_id* objects, size_t count,
                                            const graze_positions* positions) {
  return guarded([&] {
    const Views views(positions, count);
    scene_of(scene).set_positions(ids_of(objects, count), views.all(), graze::teleport);
  });
}

graze_status graze_scene_bind_positions(graze_scene* scene, const graze_id* objects, size_t count,
                                        const graze_positions* positions, uint8_t policy) {
  return guarded([&] {
    if (policy > GRAZE_WHEN_TOLD)
      throw graze::c::BadArgument("policy is " + std::to_string(policy) + ", which is no enumerator");
    const Views views(positions, count);
    scene_of(scene).bind_positions(ids_of(objects, count), views.all(),
                                   static_cast<graze::BindPolicy>(policy));
  });
}

graze_status graze_scene_unbind_positions(graze_scene* scene, graze_id object) {
  return guarded([&] { scene_of(scene).unbind_positions(same<ObjectId>(object)); });
}

graze_status graze_scene_positions_changed(graze_scene* scene, const graze_id* objects, size_t count,
                                           const double* max_displacements) {
  return guarded([&] {
    if (max_displacements == nullptr)
      scene_of(scene).positions_changed(ids_of(objects, count), graze::Scene::any_displacement);
    else
      scene_of(scene).positions_changed(ids_of(objects, count), std::span(max_displacements, count));
  });
}

graze_status graze_scene_positions_jumped(graze_scene* scene, const graze_id* objects, size_t count) {
  return guarded([&] { scene_of(scene).positions_changed(ids_of(objects, count), graze::teleport); });
}

}  // extern "C"
