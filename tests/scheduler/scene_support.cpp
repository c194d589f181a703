#include "scheduler/scene_support.hpp"

#include "support/catch.hpp"

namespace graze::tests {

std::shared_ptr<const Mesh> mesh_of(const models::MeshData& data) {
  return std::make_shared<const Mesh>(Mesh::from_polygons(data.positions, data.corners, data.corner_counts));
}

std::shared_ptr<const Mesh> plate_mesh() {
  const Positions rest = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<std::array<std::uint32_t, 4>> faces = {{0, 1, 2, 3}};
  return std::make_shared<const Mesh>(Mesh::from_quads(rest, faces));
}

std::shared_ptr<const Mesh> needle_mesh() {
  const Positions rest = {{0.25, 0.5, 0}, {0.125, 0.5, 4}, {0.375, 0.5, 4}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(rest, faces));
}

Positions moved(std::span<const Eigen::Vector3d> positions, const Eigen::Vector3d& by) {
  Positions result;
  for (const Eigen::Vector3d& position : positions) result.emplace_back(position + by);
  return result;
}

Positions lifted(const Mesh& mesh, double height) {
  return moved(mesh.rest(), {0, 0, height});
}

SceneSettings settings_of(double contact_distance, double range, ContactDetail detail) {
  SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.range = range;
  settings.detail = detail;
  settings.threads = 1;
  return settings;
}

ObjectSettings motion_of(Motion motion) {
  ObjectSettings settings;
  settings.motion = motion;
  return settings;
}

Eigen::Isometry3d lift_pose(double height) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = height;
  return pose;
}

const PairReport* find_pair(const FrameReport& report, ObjectId a, ObjectId b) {
  for (const PairReport& pair : report.pairs())
    if (pair.a == a && pair.b == b) return &pair;
  return nullptr;
}

std::vector<DiagnosticKind> kinds_of(const FrameReport& report) {
  std::vector<DiagnosticKind> kinds;
  for (const Diagnostic& diagnostic : report.diagnostics()) kinds.push_back(diagnostic.kind);
  return kinds;
}

NeedleOverPlate::NeedleOverPlate(const SceneSettings& settings, const ObjectSettings& plate_settings,
                                 const ObjectSettings& needle_settings)
    : scene(settings),
      plate(scene.add(plate_mesh(), plate_settings)),
      needle(scene.add(needle_mesh(), needle_settings)) {}

void NeedleOverPlate::lift(double height) {
  scene.set_positions(needle, lifted(*scene.mesh(needle), height));
}

ReportHandle NeedleOverPlate::step_at(double height) {
  lift(height);
  return scene.step();
}

const PairReport& only_pair(const FrameReport& report) {
  REQUIRE(report.pairs().size() == 1);
  return report.pairs()[0];
}

}  // namespace graze::tests
