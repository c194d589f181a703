// Poses, positions and faces as programs keep them, by the installed headers. Exits 0 where every value is
// right.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <graze/graze.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

namespace {

struct Vertex {
  float u, v;
  float x, y, z;
};
struct Face {
  int a, b, c;
};

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "inputs: %s\n", what);
  std::exit(1);
}

}  // namespace

int main() {
  // A plate in z = 0 as libigl has it, and a triangle as an engine has it, with its lowest vertex at the
  // origin.
  Eigen::MatrixXd plate_points(4, 3);
  plate_points << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Eigen::MatrixXi plate_faces(2, 3);
  plate_faces << 0, 1, 2, 0, 2, 3;
  std::vector<Vertex> vertices = {{0, 0, 0, 0, 0}, {1, 0, -0.25F, 0, 2}, {0, 1, 0.25F, 0, 2}};
  const std::vector<Face> faces = {{0, 1, 2}};
  const auto plate =
      std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(plate_points, plate_faces));
  const auto triangle = std::make_shared<const graze::Mesh>(
      graze::Mesh::from_triangles(graze::PositionView(vertices, &Vertex::x), faces));
  expect(plate->face_count() == 2 && plate->rest()[2] == Eigen::Vector3d(1, 1, 0), "a mesh from matrices");
  expect(triangle->rest()[1] == Eigen::Vector3d(-0.25, 0, 2), "a mesh from own structs");

  graze::SceneSettings settings;
  settings.range = 100;
  settings.threads = 1;
  graze::Scene scene(settings);
  const graze::ObjectId ground = scene.add(plate);
  graze::ObjectSettings rigid;
  rigid.motion = graze::Motion::rigid;
  const graze::ObjectId tool = scene.add(triangle, rigid);
  std::unordered_map<graze::ObjectId, double> heights;

  const auto height_by = [&](const auto& pose, std::uint64_t tag) {
    scene.set_pose(tool, pose);
    const graze::ReportHandle report = scene.step(tag);
    expect(report->tag() == tag && report->pairs().size() == 1 && report->diagnostics().empty(), "one pair");
    heights[report->pairs()[0].b] = report->pairs()[0].distance.upper;
    return heights.at(tool);
  };
  Eigen::Isometry3f in_float = Eigen::Isometry3f::Identity();
  in_float.translation() = Eigen::Vector3f(0.125F, -0.25F, 0.1F);
  expect(height_by(in_float, 1) == double(0.1F), "a float pose as it stands");
  expect(height_by(Eigen::Isometry3d(in_float.cast<double>()), 2) == double(0.1F), "a double pose");
  expect(height_by(Eigen::Matrix4f(in_float.matrix()), 3) == double(0.1F), "a 4x4 matrix of floats");
  expect(height_by(Eigen::Matrix4d(in_float.matrix().cast<double>()), 4) == double(0.1F), "a 4x4 matrix");
  expect(height_by(Eigen::Affine3f(in_float), 5) == double(0.1F), "an affine transform");
  scene.set_pose(tool, Eigen::Matrix4f(in_float.matrix().transpose()));
  expect(scene.step()->diagnostics().size() == 1, "a transposed matrix is told");
  height_by(in_float, 6);

  // The plate's matrix is read where it is, by columns.
  scene.bind_positions(ground, plate_points);
  plate_points.col(2).setConstant(-1);
  expect(scene.step()->pairs()[0].distance.upper == double(0.1F) + 1, "a bound matrix is read");
  std::puts("inputs: all values are right");
  return 0;
}
