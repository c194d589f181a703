#pragma once

#include <graze/graze.hpp>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "models/models.hpp"
#include "support/mesh_of.hpp"

namespace graze::tests {

using Positions = std::vector<Eigen::Vector3d>;

std::shared_ptr<const Mesh> mesh_of(const models::MeshData& data);

/// One square face of side 2 about the origin in z = 0, normal +z.
std::shared_ptr<const Mesh> plate_mesh();
/// One long thin triangle whose tip, vertex 0, is at (0.25, 0.5, 0). The rest lies above.
std::shared_ptr<const Mesh> needle_mesh();

Positions moved(std::span<const Eigen::Vector3d> positions, const Eigen::Vector3d& by);
Positions lifted(const Mesh& mesh, double height);

SceneSettings settings_of(double contact_distance, double range,
                          ContactDetail detail = ContactDetail::features);
ObjectSettings motion_of(Motion motion);
Eigen::Isometry3d lift_pose(double height);

/// The pair's row, null where the pair is not listed.
const PairReport* find_pair(const FrameReport& report, ObjectId a, ObjectId b);
std::vector<DiagnosticKind> kinds_of(const FrameReport& report);

/// A plate under a needle: their distance is the height of the tip, exactly, and their one contact that of
/// the tip, vertex 0 of b, and the face of a.
struct NeedleOverPlate {
  explicit NeedleOverPlate(const SceneSettings& settings, const ObjectSettings& plate_settings = {},
                           const ObjectSettings& needle_settings = {});

  /// Copies the needle's positions with the tip at `height`.
  void lift(double height);
  /// Lifts and steps.
  ReportHandle step_at(double height);

  Scene scene;
  ObjectId plate, needle;
};

/// The only row of a report.
const PairReport& only_pair(const FrameReport& report);

}  // namespace graze::tests
