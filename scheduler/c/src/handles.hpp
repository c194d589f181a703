#pragma once

#include <graze/graze.h>

#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <utility>

#include "calls.hpp"

// The structs that the handles of the C interface point at.

struct graze_mesh {
  std::shared_ptr<const graze::Mesh> mesh;
};

struct graze_scene {
  graze::Scene scene;
};

/// Holds a handle of a scene's report, or a report of its own that was copied.
struct graze_report {
  graze::ReportHandle handle;
  std::unique_ptr<const graze::FrameReport> copy;

  [[nodiscard]] const graze::FrameReport& report() const { return copy ? *copy : *handle; }
};

struct graze_query {
  graze::RepeatedQuery query;
};

struct graze_scene_query {
  graze::SceneQuery query;
};

struct graze_probe {
  graze::MeshProbe probe;
};

struct graze_patch_room {
  graze::PatchRoom room;
};

struct graze_recorder {
  graze::Recorder recorder;
};

/// Shares its recording with its replays, which read on in it.
struct graze_recording {
  std::shared_ptr<const graze::Recording> recording;
};

struct graze_replay {
  std::shared_ptr<const graze::Recording> recording;
  graze::Replay replay;
};

namespace graze::c {

/// The scene of a handle, which is not null.
[[nodiscard]] inline Scene& scene_of(graze_scene* scene) {
  return given(scene, "scene").scene;
}
[[nodiscard]] inline const Scene& scene_of(const graze_scene* scene) {
  return given(scene, "scene").scene;
}
/// The mesh of a handle, which is not null. `name` is that of the parameter.
[[nodiscard]] inline const Mesh& mesh_of(const graze_mesh* mesh, const char* name = "mesh") {
  return *given(mesh, name).mesh;
}
/// Gives the caller a handle of a mesh, or null for no mesh.
inline void give_mesh(std::shared_ptr<const Mesh> mesh, graze_mesh** room) {
  given(room, "mesh") = mesh ? new graze_mesh{std::move(mesh)} : nullptr;
}

}  // namespace graze::c
