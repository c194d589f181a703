// Hidden groups as a game uses them: a crate slides over a row of solid tiles, each an object of its own, of
// which the inner walls are hidden.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Vector = Eigen::Vector3d;

/// The walls of a box in the order of its quads.
enum Wall : std::uint8_t { bottom, top, front, right, back, left };

/// A closed box of six quads, outward, in the order of `Wall`: `front` is at low y, `right` at high x.
std::shared_ptr<const Mesh> box_mesh(const Vector& half, const Vector& centre = Vector::Zero()) {
  constexpr std::array<std::array<int, 4>, 6> quads{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  constexpr std::array<std::array<int, 3>, 8> corners{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  Positions points;
  for (const auto& corner : corners)
    points.push_back(centre + half.cwiseProduct(Vector(corner[0], corner[1], corner[2])));
  return std::make_shared<const Mesh>(Mesh::from_quads(points, quads));
}

/// A box that moves by forces, with pushes as positions. It has mass 1 and no friction.
class Crate {
 public:
  Crate(const Vector& half, const Eigen::Isometry3d& pose, const Vector& velocity)
      : pose_(pose), velocity_(velocity) {
    const Vector squares = half.cwiseProduct(half);
    inertia_ = (Vector::Constant(squares.sum()) - squares) / 3;
  }
  [[nodiscard]] const Eigen::Isometry3d& pose() const { return pose_; }
  [[nodiscard]] const Vector& velocity() const { return velocity_; }

  /// A plane that a point of the crate stays in front of.
  struct Hold {
    Vector local;  ///< the point, seen from the crate
    Vector point;  ///< where it was
    Vector push;
    double separation = 0;
  };
  void move(double time, const std::vector<Hold>& holds) {
    const Eigen::Isometry3d before = pose_;
    velocity_.z() -= 9.81 * time;
    pose_.translation() += velocity_ * time;
    turn(spin_ * time);
    for (int round = 0; round < 8; ++round)
      for (const Hold& hold : holds) apply(hold);
    velocity_ = (pose_.translation() - before.translation()) / time;
    const Eigen::AngleAxisd turned(pose_.linear() * before.linear().transpose());
    spin_ = turned.angle() / time * turned.axis();
  }

 private:
  void turn(const Vector& by) {
    if (by.norm() > 0)
      pose_.linear() = Eigen::AngleAxisd(by.norm(), by.normalized()).toRotationMatrix() * pose_.linear();
  }
  void apply(const Hold& hold) {
    const Vector point = pose_ * hold.local;
    const double missing = -(hold.separation + hold.push.dot(point - hold.point));
    if (missing <= 0) return;
    const Vector lever = (point - pose_.translation()).cross(hold.push);
    const Vector turned = pose_.linear() * (pose_.linear().transpose() * lever).cwiseQuotient(inertia_);
    const double impulse = missing / (1 + lever.dot(turned));
    pose_.translation() += impulse * hold.push;
    turn(impulse * turned);
  }

  Eigen::Isometry3d pose_;
  Vector velocity_;
  Vector spin_ = Vector::Zero();
  Vector inertia_;
};

/// What becomes of the walls between tiles.
enum class InnerWalls : std::uint8_t { seen, hidden, missing };

struct Slide {
  InnerWalls walls = InnerWalls::hidden;
  int rows = 1;       ///< with two of them the crate slides along the seam between them
  double height = 0;  ///< of the crate's bottom over the tiles at the beginning
  double yaw = 0;     ///< of the crate
  double turn = 0;    ///< of the floor
};

struct Slid {
  double slowest = 0;  ///< along the row
  double lowest = 0;   ///< the crate's bottom
  double end = 0;      ///< how far it came
};

constexpr int columns = 12;
constexpr double speed = 2;

/// A tile, 1 long and 1.5 wide, whose walls to its neighbours are in group 1. Its top is at z = 0.
ObjectId add_tile(Scene& scene, const Slide& slide, int column, int row) {
  ObjectSettings settings = motion_of(Motion::fixed);
  settings.face_groups.assign(6, 0);
  if (column > 0) settings.face_groups[left] = 1;
  if (column + 1 < columns) settings.face_groups[right] = 1;
  if (row > 0) settings.face_groups[front] = 1;
  if (row + 1 < slide.rows) settings.face_groups[back] = 1;
  const double y = 1.5 * (row - 0.5 * (slide.rows - 1));
  auto mesh = box_mesh({0.5, 0.75, 0.25}, {column + 0.5, y, -0.25});
  settings.solid = slide.walls != InnerWalls::missing;
  if (slide.walls == InnerWalls::hidden) settings.hidden_groups = {1};
  if (slide.walls == InnerWalls::missing) {
    std::vector<std::array<std::uint32_t, 4>> quads;
    for (std::uint32_t face = 0; face < mesh->face_count(); ++face)
      if (settings.face_groups[face] == 0)
        std::copy_n(mesh->face(face).begin(), 4, quads.emplace_back().begin());
    mesh = std::make_shared<const Mesh>(Mesh::from_quads(mesh->rest(), quads));
    settings.face_groups.clear();
  }
  const ObjectId tile = scene.add(mesh, settings);
  scene.set_pose(tile, Eigen::Isometry3d(Eigen::AngleAxisd(slide.turn, Vector::UnitZ())));
  return tile;
}

Slid play(const Slide& slide) {
  constexpr double frame_time = 1.0 / 60;
  constexpr int substeps = 10;
  const Vector half(0.25, 0.25, 0.25);
  Scene scene(settings_of(0.05, 0, ContactDetail::nearest));
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < slide.rows; ++row) (void)add_tile(scene, slide, column, row);
  ObjectSettings rigid = motion_of(Motion::rigid);
  rigid.solid = true;
  const ObjectId id = scene.add(box_mesh(half), rigid);

  const Eigen::AngleAxisd turn(slide.turn, Vector::UnitZ());
  const Vector along = turn * Vector::UnitX();
  const Eigen::Isometry3d start(turn * Eigen::Translation3d(0.5, 0.0123, half.z() + slide.height) *
                                Eigen::AngleAxisd(slide.yaw, Vector::UnitZ()));
  Crate crate(half, start, speed * along);
  Slid slid{speed, slide.height, 0};
  for (int frame = 0; frame < 340 && slid.end < columns - 1.5; ++frame) {
    scene.set_pose(id, crate.pose());
    const ReportHandle report = scene.step();
    std::vector<Crate::Hold> holds;
    for (const Contact& contact : report->contacts())
      if (contact.kind != ContactKind::EF)
        holds.push_back({crate.pose().inverse() * contact.point_b, contact.point_b, contact.push(),
                         contact.separation()});
    for (int part = 0; part < substeps; ++part) crate.move(frame_time / substeps, holds);
    slid.slowest = std::min(slid.slowest, crate.velocity().dot(along));
    slid.lowest = std::min(slid.lowest, crate.pose().translation().z() - half.z());
    slid.end = (crate.pose().translation() - start.translation()).dot(along);
  }
  return slid;
}

}  // namespace

TEST_CASE("hidden groups: a crate that slides over tiles with hidden inner walls keeps its speed") {
  for (const int rows : {1, 2})
    for (const double height : {0.0, 1e-4, -1e-4, -1e-3, 0.002})
      for (const double yaw : {0.0, 0.1, 0.7})
        for (const double turn : {0.0, 0.3}) {
          const Slid slid = play({InnerWalls::hidden, rows, height, yaw, turn});
          INFO(rows << " rows, height " << height << ", yaw " << yaw << ", turn " << turn << ": "
                    << slid.slowest << ", " << slid.lowest << ", " << slid.end);
          CHECK(slid.slowest > 0.999 * speed);
          CHECK(slid.lowest > std::min(height, 0.0) - 1e-4);
          CHECK(slid.end >= columns - 1.5);
        }
}

TEST_CASE("hidden groups: a crate trips over inner walls that are seen, and over borders in their place") {
  for (const InnerWalls walls : {InnerWalls::seen, InnerWalls::missing})
    for (const double height : {0.0, -1e-3}) {
      const Slid slid = play({walls, 1, height, 0.1, 0});
      std::cout << (walls == InnerWalls::seen ? "inner walls seen" : "inner walls missing") << ", height "
                << height << ": slowest " << slid.slowest << " of " << speed << " m/s, came " << slid.end
                << " m\n";
      CHECK(slid.slowest < 0.5 * speed);
    }
}

}  // namespace graze::tests
