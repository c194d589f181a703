#include <cmath>
#include <utility>

#include "bench/scenes/scene_makers.hpp"
#include "bench/scenes/wobbling.hpp"
#include "scenes/grid.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

using scenes::Random;
using Vector = Eigen::Vector3d;

/// Cell `index` of a packing in which a ball of radius 1 has twelve neighbours, `columns` along each row.
Vector packed(std::size_t index, std::size_t columns) {
  const auto column = static_cast<double>(index % columns);
  const std::size_t row = index / columns % columns;
  const std::size_t layer = index / columns / columns;
  const double root = std::sqrt(3.0);
  return {2 * column + static_cast<double>((row + layer) % 2),
          root * (static_cast<double>(row) + static_cast<double>(layer % 2) / 3),
          2 * std::sqrt(2.0 / 3) * static_cast<double>(layer)};
}

/// Returns the body with its motion taken away: it is placed once, in frame 0.
Body resting(Body body) {
  body.place = [place = std::move(body.place)](std::size_t frame, std::span<float> out) {
    return frame == 0 && place(0, out);
  };
  return body;
}

/// A body at rest whose vertices tremble in every frame.
Body trembling(Body body, double by, std::uint64_t seed) {
  body.place = [place = std::move(body.place), by, seed](std::size_t frame, std::span<float> out) {
    place(0, out);
    Random random(seed * 1'000'003 + frame);
    for (float& value : out) value += static_cast<float>(random.between(-by, by));
    return true;
  };
  return body;
}

// The landscape: hills, and props of radius 1 in rows.
constexpr double prop_spacing = 4.4;
constexpr std::size_t prop_columns = 23;
constexpr std::size_t prop_count = 500;
constexpr double land_side = prop_spacing * prop_columns;

double height(double x, double y) {
  return 0.8 * std::sin(0.21 * x) * std::cos(0.17 * y);
}

Vector prop_place(std::size_t index) {
  const double x = prop_spacing * (static_cast<double>(index % prop_columns) + 0.5);
  const std::size_t row = index / prop_columns;
  const double y = prop_spacing * (static_cast<double>(row) + 0.5);
  return {x, y, 0};
}

bool is_under_props(const Vector& point) {
  constexpr double reach = 1.6;
  const double x = std::fmod(point.x(), prop_spacing) - prop_spacing / 2;
  const double y = std::fmod(point.y(), prop_spacing) - prop_spacing / 2;
  return std::abs(x) < reach && std::abs(y) < reach;
}

models::MeshData hills() {
  constexpr std::uint32_t cells = 1000;
  models::MeshData land = models::sheet(cells, cells, land_side, land_side, models::Faces::triangles);
  for (Vector& point : land.positions) {
    point += Vector(land_side / 2, land_side / 2, 0);
    point.z() = height(point.x(), point.y());
    point =
        scenes::on_grid(point);  // what stands still is placed by its rest shape: its floats must be the same
  }
  return land;
}

/// Returns the part of the land that lies under the props.
models::MeshData cropped(const models::MeshData& land) {
  models::MeshData part;
  std::vector<std::uint32_t> numbers(land.positions.size(), Mesh::no_edge);
  for (std::size_t i = 0; i < land.corners.size(); i += 3) {
    if (!is_under_props(land.positions[land.corners[i]])) continue;
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      std::uint32_t& number = numbers[land.corners[corner]];
      if (number == Mesh::no_edge) {
        number = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(land.positions[land.corners[corner]]);
      }
      part.corners.push_back(number);
    }
    part.corner_counts.push_back(3);
  }
  return part;
}

Body standing(const models::MeshData& data) {
  const auto mesh = scenes::mesh_of(data);
  const auto place = [mesh](std::size_t frame, std::span<float> out) {
    if (frame > 0) return false;
    std::size_t next = 0;
    for (const Vector& rest : mesh->rest())
      for (int axis = 0; axis < 3; ++axis) out[next++] = static_cast<float>(rest[axis]);
    return true;
  };
  return {mesh, place, true};
}

/// A prop that wobbles, and slides over the hills.
Body prop(const std::shared_ptr<const Mesh>& mesh, const Vector& at, double phase) {
  const auto place = [mesh, at, phase](std::size_t frame, std::span<float> out) {
    const auto time = static_cast<double>(frame);
    const double x = at.x() + 0.3 * std::sin(0.1 * time + phase);
    const double y = at.y() + 0.3 * std::cos(0.1 * time + phase);
    const Vector centre(x, y, height(x, y) + 1.01);
    std::size_t next = 0;
    for (const Vector& rest : mesh->rest()) {
      const double swell = 1 + 0.01 * std::sin(0.3 * time + phase + 5 * rest.z());
      for (int axis = 0; axis < 3; ++axis)
        out[next++] = static_cast<float>(centre[axis] + swell * rest[axis]);
    }
    return true;
  };
  return {mesh, place};
}

}  // namespace

BenchScene heap(bool is_noisy) {
  BenchScene scene{is_noisy ? "S8b" : "S8a",
                   is_noisy ? "1,000 bodies of 1,000 vertices in a heap, with noise of 1e-6 edge lengths"
                            : "1,000 bodies of 1,000 vertices in a heap, at rest",
                   0.04,
                   300,
                   {}};
  constexpr double edge = 0.157;
  scene.is_told = true;
  Random random(8);
  const auto mesh = scenes::mesh_of(models::sphere(40, 25));
  for (std::size_t i = 0; i < 1000; ++i) {
    Path path;
    path.turn = random.turn();
    path.centre = 1.005 * packed(i, 10);
    Body body = wobbling(mesh, path);
    scene.bodies.push_back(is_noisy ? trembling(std::move(body), 1e-6 * edge, i) : resting(std::move(body)));
  }
  return scene;
}

BenchScene sleepers() {
  BenchScene scene{"S9", "10,000 bodies of 258 vertices, 100 of them move", 0.04, 300, {}};
  scene.is_told = scene.has_sleepers = true;
  Random random(9);
  const auto mesh = scenes::mesh_of(models::sphere(16, 16));
  for (std::size_t i = 0; i < 10'000; ++i) {
    Path path;
    path.turn = random.turn();
    path.centre = 1.005 * packed(i, 22);
    path.reach = {0.02, 0.02, 0.02};
    path.speed = {0.1, 0.13, 0.16};
    path.phase = random.between(0, 6);
    path.wobble = 0.01;
    Body body = wobbling(mesh, path);
    scene.bodies.push_back(i % 100 == 50 ? std::move(body) : resting(std::move(body)));
  }
  return scene;
}

BenchScene landscape(bool is_cropped) {
  BenchScene scene{is_cropped ? "S10b" : "S10a",
                   is_cropped ? "500 props of 500 vertices on what lies under them of a landscape"
                              : "500 props of 500 vertices on a landscape of 2 million triangles",
                   0.04,
                   60,
                   {}};
  scene.bodies.push_back(standing(is_cropped ? cropped(hills()) : hills()));
  Random random(10);
  const auto mesh = scenes::mesh_of(models::sphere(25, 20));
  for (std::size_t i = 0; i < prop_count; ++i)
    scene.bodies.push_back(prop(mesh, prop_place(i), random.between(0, 6)));
  return scene;
}

}  // namespace graze::bench
