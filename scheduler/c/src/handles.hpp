#pragma once

#include <graze/graze.h>

#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <memory>

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
