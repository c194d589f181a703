#pragma once

#include <graze/graze.h>

#include <array>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "models/models.hpp"

namespace graze::tests {

/// Frees a handle of C.
struct Release {
  void operator()(graze_mesh* mesh) const { graze_mesh_release(mesh); }
  void operator()(graze_scene* scene) const { graze_scene_release(scene); }
  void operator()(graze_report* report) const { graze_report_release(report); }
  void operator()(graze_query* query) const { graze_query_release(query); }
  void operator()(graze_scene_query* query) const { graze_scene_query_release(query); }
  void operator()(graze_probe* probe) const { graze_probe_release(probe); }
  void operator()(graze_patch_room* room) const { graze_patch_room_release(room); }
  void operator()(graze_recorder* recorder) const { graze_recorder_release(recorder); }
  void operator()(graze_recording* recording) const { graze_recording_release(recording); }
  void operator()(graze_replay* replay) const { graze_replay_release(replay); }
};
template <typename Handle>
using Owned = std::unique_ptr<Handle, Release>;

/// Stops the test where a call of C fails, and says what it says.
void expect_ok(graze_status status);
/// Expects a call of C to fail as `status` says, with a sentence that has `words`.
void expect_fails(graze_status ended, graze_status status, const std::string& words);

[[nodiscard]] graze_positions doubles(std::span<const Eigen::Vector3d> points);
[[nodiscard]] Owned<graze_mesh> c_mesh(const models::MeshData& data);
[[nodiscard]] Owned<graze_scene> c_scene(const SceneSettings& settings);
[[nodiscard]] graze_scene_settings c_settings(const SceneSettings& settings);
[[nodiscard]] graze_object_settings c_settings(const ObjectSettings& settings);
/// Does not compile: the struct points into the settings.
graze_object_settings c_settings(ObjectSettings&& settings) = delete;

/// The upper three rows of a pose.
[[nodiscard]] std::array<double, 12> rows_of(const Eigen::Isometry3d& pose);

/// Whether a report of C says what one of C++ says, and shows it where it lies.
[[nodiscard]] bool is_same(const graze_report* report, const FrameReport& expected);

}  // namespace graze::tests
