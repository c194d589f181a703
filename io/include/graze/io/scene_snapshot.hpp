#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/report.hpp>
#include <memory>
#include <string>
#include <vector>

namespace graze::io {

/// @addtogroup io_exports
/// @{

/// An object of a SceneSnapshot.
struct SnapshotObject {
  /// The id of the object in the reports of its scene.
  ObjectId id;
  /// A number that tells objects apart from frame to frame, such as ReplayObject::serial.
  std::uint64_t serial = 0;
  /// A name for people. Names may repeat or be empty.
  std::string name;
  /// The faces of the object.
  std::shared_ptr<const Mesh> mesh;
  /// A position for each vertex of the mesh. Those of vertices that a face uses are finite. Tables do not
  /// need positions.
  std::vector<Eigen::Vector3d> positions;
};

/// A frame of a scene, as the exports take it: where the objects are, and what the report says of them.
struct SceneSnapshot {
  /// The number of the frame in the exported files.
  std::uint64_t frame = 0;
  /// FrameReport::frame() as the caller's program knows it.
  std::uint64_t scene_frame = 0;
  /// The caller's number of the frame in which a contact began, by its Contact::since. Where the vector has
  /// no number for it, exports give Contact::since itself.
  std::vector<std::uint64_t> frames_by_since;
  /// The objects of the scene, in any order.
  std::vector<SnapshotObject> objects;
  /// Objects that were removed before this step. The report may still name them in a row that ended.
  std::vector<SnapshotObject> removed;
  /// The report of the frame. It is not null.
  ReportHandle report;
};

/// @}

}  // namespace graze::io
