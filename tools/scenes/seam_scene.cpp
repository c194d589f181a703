#include "scenes/seam_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "models/models.hpp"
#include "scenes/grid.hpp"
#include "scenes/scene_parts.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t columns = 12;
constexpr std::uint8_t beside_seam = 1;  ///< the group of the faces along the seam
constexpr std::size_t cut_every = 3;     ///< frames
constexpr std::size_t sew_every = 4;     ///< frames

/// A sheet of triangles, of which the first `left` are there.
std::shared_ptr<const Mesh> sheet_of(std::size_t left) {
  models::MeshData data = models::sheet(columns, columns, 1.5, 1.5, models::Faces::triangles);
  data.corner_counts.resize(std::min(left, data.corner_counts.size()));
  data.corners.resize(3 * data.corner_counts.size());
  return mesh_on_grid(data);
}

/// The faces that have a vertex at the sheet's right border are beside the seam.
std::vector<std::uint8_t> groups_of(const Mesh& mesh) {
  std::vector<std::uint8_t> groups;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const auto corners = mesh.face(face);
    const bool is_beside = std::any_of(corners.begin(), corners.end(),
                                       [&](std::uint32_t corner) { return mesh.rest()[corner].x() > 0.7; });
    groups.push_back(is_beside ? beside_seam : 0);
  }
  return groups;
}

class SeamScene : public PlayedScene {
 public:
  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.05, 0.2); }

  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0) add_all(scene);
    if (frame % cut_every == cut_every - 1) cut(scene);
    if (frame % sew_every == 0) sew(scene, frame % (2 * sew_every) == 0);
    const auto time = static_cast<double>(frame);
    place(scene, sheet_, *cut_sheet_, {-0.74, 0, 0}, 0.3 * time);
    place(scene, other_, *whole_sheet_, {0.74, 0, 0.01}, 0.3 * time + 1);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = on_grid({0.4 * std::sin(0.2 * time), 0.1, 0.35 - 0.1 * std::sin(0.3 * time)});
    scene.set_pose(ball_, pose);
  }

 private:
  void add_all(Scene& scene) {
    const auto groups = groups_of(*whole_sheet_);
    sheet_ = scene.add(cut_sheet_, {.name = "cut", .face_groups = groups});
    // The second sheet lies with the same border at the seam, so its groups are those of its mirror image.
    other_ = scene.add(whole_sheet_, {.name = "whole", .face_groups = {groups.rbegin(), groups.rend()}});
    models::MeshData ball = models::sphere(12, 8);
    for (Vector3d& position : ball.positions) position *= 0.4;
    ball_ = scene.add(mesh_on_grid(ball), {.name = "ball", .motion = Motion::rigid, .solid = true});
  }
  /// Takes faces away from the sheet. All vertices stay.
  void cut(Scene& scene) {
    cut_sheet_ = sheet_of(cut_sheet_->face_count() - 5);
    std::vector<std::uint32_t> new_of_old(cut_sheet_->vertex_count());
    std::iota(new_of_old.begin(), new_of_old.end(), 0U);
    scene.replace_mesh(sheet_, cut_sheet_, new_of_old, groups_of(*cut_sheet_));
  }
  void sew(Scene& scene, bool is_sewn) {
    if (is_sewn)
      scene.ignore(sheet_, beside_seam, other_, beside_seam);
    else
      scene.watch(sheet_, beside_seam, other_, beside_seam);
  }
  static void place(Scene& scene, ObjectId id, const Mesh& mesh, const Vector3d& centre, double phase) {
    std::vector<Vector3d> positions;
    for (const Vector3d& rest : mesh.rest())
      positions.push_back(
          on_grid(centre + rest + Vector3d(0, 0, 0.05 * std::sin(3 * rest.x() + 2 * rest.y() + phase))));
    scene.set_positions(id, positions);
  }

  std::shared_ptr<const Mesh> whole_sheet_ = sheet_of(2 * std::size_t{columns} * columns);
  std::shared_ptr<const Mesh> cut_sheet_ = whole_sheet_;
  ObjectId sheet_, other_, ball_;
};

}  // namespace

std::unique_ptr<PlayedScene> make_seam_scene() {
  return std::make_unique<SeamScene>();
}

}  // namespace graze::scenes
