#include "experiment/regions/deforming_scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <graze/io/motion.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "accuracy/models.hpp"
#include "bench/scenes/wobbling.hpp"
#include "core/base/box.hpp"
#include "mean_edge_length.hpp"
#include "models/models.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/skinned_human.hpp"

namespace graze::tools {
namespace {

using bench::BenchScene;
using Vector = Eigen::Vector3d;

void write(const Vector& point, std::size_t vertex, std::span<float> out) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    out[3 * vertex + axis] = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
}

constexpr std::uint32_t cells_along = 120, cells_across = 60, cells_a_panel = 12;
constexpr double cell = 1.0 / cells_a_panel;
constexpr double steep = 1.5, level = 0.1;

/// An accordion of panels that stand at `slope` to the ground, up and down in turns, each a unit long. The
/// whole of it is turned, so that neither panels nor folds lie along an axis.
std::vector<Vector> accordion(double slope, double height) {
  const Eigen::AngleAxisd turn(0.6, Vector(1, 2, 3).normalized());
  std::vector<Vector> points;
  for (std::uint32_t row = 0; row <= cells_across; ++row)
    for (std::uint32_t column = 0; column <= cells_along; ++column) {
      const double in_panel = cell * (column % cells_a_panel);
      const bool goes_up = column / cells_a_panel % 2 == 0;
      points.push_back(turn * Vector(cell * column * std::cos(slope), cell * row,
                                     (goes_up ? in_panel : 1 - in_panel) * std::sin(slope) + height));
    }
  return points;
}

BenchScene folding(std::string name, std::string what, double rest_slope, double last_slope) {
  BenchScene scene{std::move(name), std::move(what), cell, 24, {}};
  for (const double height : {0.0, 0.6 * cell}) {
    models::MeshData sheet = models::sheet(cells_along, cells_across, 1, 1, models::Faces::triangles);
    sheet.positions = accordion(rest_slope, height);
    const auto place = [=, frames = scene.frames](std::size_t frame, std::span<float> out) {
      const double part = static_cast<double>(frame) / static_cast<double>(frames - 1);
      const std::vector<Vector> points = accordion(rest_slope + part * (last_slope - rest_slope), height);
      for (std::size_t i = 0; i < points.size(); ++i) write(points[i], i, out);
      return true;
    };
    scene.bodies.push_back({scenes::mesh_of(sheet), place});
  }
  return scene;
}

}  // namespace

BenchScene scene_of(const RecordedMotion& motion, std::string what, double edges) {
  BenchScene scene{motion.name, std::move(what), edges * motion.mean_edge_length, motion.frame_count(), {}};
  for (const RecordedObject& object : motion.objects) {
    const auto place = [frames = object.frames](std::size_t frame, std::span<float> out) {
      std::copy(frames[frame].begin(), frames[frame].end(), out.begin());
      return true;
    };
    scene.bodies.push_back({object.mesh, place});
  }
  return scene;
}

BenchScene meeting_models(std::uint64_t seed) {
  constexpr std::uint32_t frames = 24;
  const auto models = std::make_shared<const MovingModels>(seed, frames);
  BenchScene scene{"models",
                   "the paper's five models, bending and twisting, which meet and part",
                   models->mean_edge_length(),
                   frames,
                   {}};
  for (std::size_t body = 0; body < models->size(); ++body) {
    const auto place = [models, body](std::size_t frame, std::span<float> out) {
      const std::vector<Vector> positions = models->positions(body, static_cast<std::uint32_t>(frame));
      for (std::size_t i = 0; i < positions.size(); ++i) write(positions[i], i, out);
      return true;
    };
    scene.bodies.push_back({models->mesh(body), place});
  }
  return scene;
}

BenchScene unfolding_sheets() {
  return folding("unfolding", "two sheets of 7,381 vertices on each other that rest folded up and unfold",
                 steep, level);
}

BenchScene folding_sheets() {
  return folding("folding", "two sheets of 7,381 vertices on each other that rest flat and fold up", level,
                 steep);
}

BenchScene striding_humans() {
  const auto human = std::make_shared<const scenes::SkinnedHuman>();
  const std::vector<std::shared_ptr<const Mesh>> meshes{human->mesh()};
  BenchScene scene{
      "striding", "four humans of 946 vertices who stride in a crowd", mean_edge_length(meshes), 24, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t column = i % 2;
    const std::size_t row = i / 2;
    const Vector place(0.42 * static_cast<double>(column), 0.36 * static_cast<double>(row), 0);
    const auto pose = [human, place, i](std::size_t frame, std::span<float> out) {
      std::vector<Vector> positions;
      human->pose(2 * std::numbers::pi * static_cast<double>(frame) / 24 + 1.3 * static_cast<double>(i),
                  positions);
      for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
        write(positions[vertex] + place, vertex, out);
      return true;
    };
    scene.bodies.push_back({human->mesh(), pose});
  }
  return scene;
}

BenchScene rigid_tori() {
  const auto mesh = scenes::mesh_of(models::torus(80, 50, 0.7, 0.2));
  const std::vector<std::shared_ptr<const Mesh>> meshes{mesh};
  BenchScene scene{"rigid",
                   "six linked tori of 4,000 vertices that turn without deforming",
                   mean_edge_length(meshes),
                   24,
                   {}};
  for (std::size_t i = 0; i < 6; ++i) {
    const double upright = i % 2 == 0 ? 0 : std::numbers::pi / 2;
    const auto place = [mesh, i, upright](std::size_t frame, std::span<float> out) {
      const double time = 0.13 * static_cast<double>(frame) + static_cast<double>(i);
      // About the chain's own direction all turn alike and stay linked. About their own axes each turns by
      // itself.
      const Eigen::Matrix3d turn =
          (Eigen::AngleAxisd(upright + 0.13 * static_cast<double>(frame), Vector::UnitX()) *
           Eigen::AngleAxisd(time, Vector::UnitZ()))
              .toRotationMatrix();
      const Vector centre(0.995 * static_cast<double>(i), 0.02 * std::sin(time), 0.02 * std::cos(2 * time));
      for (std::size_t vertex = 0; vertex < mesh->rest().size(); ++vertex)
        write(turn * mesh->rest()[vertex] + centre, vertex, out);
      return true;
    };
    scene.bodies.push_back({mesh, place});
  }
  return scene;
}

BenchScene posing_wolves(const std::string& data) {
  const std::filesystem::path file = data + "/poses/wolf-poses-2.obj";
  BenchScene scene{"wolves", "two wolves of 5,075 vertices in 21 poses", 0, 21, {}};
  if (!std::filesystem::exists(file)) {
    scene.missing = "no file " + file.string();
    return scene;
  }
  const auto mesh = io::MeshFile::read(file).objects()[0].mesh;
  const std::vector<std::shared_ptr<const Mesh>> meshes{mesh};
  scene.distance = mean_edge_length(meshes);
  Box box;
  for (const Vector& point : mesh->rest()) box.add(point);
  Eigen::Index side = 0;
  (box.max - box.min).minCoeff(&side);
  const Vector beside = 0.75 * (box.max - box.min)[side] * Vector::Unit(side);
  auto cache = file;
  cache.replace_extension(".pc2");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::shared_ptr<io::PositionSource> source = io::open_vertex_cache(cache, *mesh);
    const auto pose = [source, offset = Vector(static_cast<double>(i) * beside), i](std::size_t frame,
                                                                                    std::span<float> out) {
      std::vector<Vector> positions;
      source->read(static_cast<std::uint32_t>((frame + 5 * i) % 21), positions);
      for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
        write(positions[vertex] + offset, vertex, out);
      return true;
    };
    scene.bodies.push_back({mesh, pose});
  }
  return scene;
}

}  // namespace graze::tools
