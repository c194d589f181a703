// Queries between steps: a ray picks a crate, a sphere walks along a wall and slides around its end, and a
// box is put where it is free. All ask one report, while the scene could step on.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;

std::shared_ptr<const graze::Mesh> box_mesh(const Vector3d& size) {
  const examples::Shape shape = examples::box(size);
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
}

/// A floor, a wall along y on it, and a crate behind the wall. All of them ask for queries.
struct Room {
  Room() {
    const auto add = [&](const char* name, const Vector3d& size, const Vector3d& place) {
      const graze::ObjectId id = scene.add(
          box_mesh(size), {.name = name, .motion = graze::Motion::rigid, .solid = true, .queries = true});
      scene.set_pose(id, Eigen::Isometry3d(Eigen::Translation3d(place)));
      return id;
    };
    ground = add("ground", {20, 20, 1}, {0, 0, -0.5});
    wall = add("wall", {0.2, 6, 2}, {1, 0, 1});
    crate = add("crate", {1, 1, 1}, {3, 0, 0.5});
    query.set_report(scene.step());
  }

  graze::Scene scene{graze::SceneSettings{.threads = 1}};
  graze::ObjectId ground, wall, crate;
  graze::SceneQuery query;
};

/// Aims at the crate: the wall is in the way from the front, and nothing is from above.
bool picks(Room& room) {
  const auto from_front = room.query.cast_ray({-3, 0, 0.5}, {1, 0, 0});
  const auto from_above = room.query.cast_ray({3, 0, 5}, {0, 0, -1});
  if (!from_front || !from_above) return false;
  std::printf("the ray from the front hits at x = %.2f, the one from above at z = %.2f\n",
              from_front->point.x(), from_above->point.z());
  return from_front->object == room.wall && from_above->object == room.crate && from_above->t == 4;
}

/// Walks to a place with a sphere of 30 cm. Where it touches something, the rest of the way is made along the
/// surface. Returns where it ends.
Vector3d walk(Room& room, Vector3d place, const Vector3d& goal) {
  constexpr double radius = 0.3;
  constexpr double skin = 0.01;  // left between the sphere and what it touches
  for (int step = 0; step < 100; ++step) {
    Vector3d way = goal - place;
    if (way.norm() < skin) break;
    way *= std::min(1.0, 0.2 / way.norm());
    for (int slide = 0; slide < 3; ++slide) {
      const auto touch = room.query.cast_sphere(place, place + way, radius + skin);
      if (!touch) {
        place += way;
        break;
      }
      place = touch->centre + 1e-9 * touch->normal;  // so that it does not begin in touch
      way *= 1 - touch->t;
      way -= std::min(0.0, way.dot(touch->normal)) * touch->normal;
    }
  }
  return place;
}

/// The wall is 2 m high and ends at y = 3. A goal behind it draws the sphere along it, to where it is
/// nearest.
bool slides(Room& room) {
  const Vector3d behind = walk(room, {-2, 1, 0.4}, {2, 2, 0.4});
  const Vector3d around = walk(room, walk(room, behind, {0, 4, 0.4}), {2, 4, 0.4});
  std::printf("the sphere stops at (%.2f %.2f) before the wall, and goes around it to (%.2f %.2f)\n",
              behind.x(), behind.y(), around.x(), around.y());
  return std::abs(behind.x() - (0.9 - 0.31)) < 1e-3 && std::abs(behind.y() - 2) < 0.05 &&
         (around - Vector3d(2, 4, 0.4)).norm() < 0.02;
}

/// Puts a second crate at the first place along x where it has 5 cm of room: between the wall and the first.
bool places(Room& room) {
  graze::MeshProbe probe(box_mesh({1, 1, 1}), true);
  graze::QueryFilter filter;
  filter.ignored = room.ground;  // on which it stands
  double x = 0.5;
  int tried = 0;
  for (; x < 6; x += 0.1, ++tried) {
    probe.set_pose(Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0.5)));
    if (room.query.is_free(probe, 0.05, filter)) break;
  }
  const auto beside = room.query.closest_point({x, 0, 0.5}, 10, filter);
  std::printf("after %d places the second crate is free at x = %.2f, %.2f m from what is nearest\n", tried, x,
              beside->distance - 0.5);
  return std::abs(x - 1.7) < 1e-9 && beside->object == room.wall;
}

}  // namespace

int main() {
  Room room;
  const bool holds = picks(room) && slides(room) && places(room);
  std::printf("aiming, walking and placing %s\n", holds ? "agree with the scene" : "went wrong");
  return holds ? 0 : 1;
}
