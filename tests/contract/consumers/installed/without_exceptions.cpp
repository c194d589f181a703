// Uses every template of the headers whose errors are exceptions of the library.
#include <graze/graze.hpp>

struct Vertex {
  float u, v, x, y, z;
};

int main() {
  const std::array<Vertex, 3> vertices{{{0, 0, 0, 0, 0}, {0, 0, 1, 0, 0}, {0, 0, 0, 1, 0}}};
  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, 3);
  points(1, 0) = points(2, 1) = 1;
  const Eigen::MatrixXi rows = Eigen::RowVector3i(0, 1, 2);
  const auto mesh = std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(points, rows));
  graze::Scene scene({.contact_distance = 0.1, .threads = 1});
  scene.add(mesh);
  const graze::ObjectId other = scene.add(mesh);
  scene.set_positions(other, graze::PositionView(vertices, &Vertex::x));
  const bool is_welded = graze::weld(points, rows).mesh.vertex_count() == 3;
  return scene.step()->contacts().empty() || !is_welded ? 1 : 0;
}
