#include "scenes/coinciding_scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "models/models.hpp"
#include "scenes/scene_parts.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

/// A smooth wave of period 4 between -1 and 1, of sums and products alone.
double wave(double x) {
  const double phase = x - 4 * std::floor(x / 4);  // 0 to 4
  const double half = phase < 2 ? phase : phase - 2;
  const double height = half * (2 - half);
  return phase < 2 ? height : -height;
}

/// A sheet of columns × rows cells in z = 0, normal +z, triangles. Its coordinates have all the bits of a
/// double.
models::MeshData fine_sheet(std::uint32_t cells, double cell) {
  models::MeshData data;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      data.positions.emplace_back((i - 0.5 * cells) * cell, (j - 0.5 * cells) * cell, 0);
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t corner = j * (cells + 1) + i;
      data.add_face({corner, corner + 1, corner + cells + 2});
      data.add_face({corner, corner + cells + 2, corner + cells + 1});
    }
  return data;
}

/// Two or more objects of one mesh, each told its positions in every frame.
class CopiesScene : public PlayedScene {
 public:
  /// Gives the position of a vertex of an object in a frame.
  using Place = std::function<Vector3d(const Vector3d& rest, std::size_t object, double frame)>;

  CopiesScene(SceneSettings settings, std::shared_ptr<const Mesh> mesh, std::size_t count, Place place)
      : settings_(std::move(settings)), mesh_(std::move(mesh)), ids_(count), place_(std::move(place)) {}

  [[nodiscard]] SceneSettings settings() const override { return settings_; }
  void advance(Scene& scene, std::size_t frame) override {
    for (std::size_t object = 0; object < ids_.size(); ++object) {
      if (frame == 0) ids_[object] = scene.add(mesh_);
      positions_.clear();
      for (const Vector3d& rest : mesh_->rest())
        positions_.push_back(place_(rest, object, static_cast<double>(frame)));
      scene.set_positions(ids_[object], positions_);
    }
  }

 private:
  SceneSettings settings_;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<ObjectId> ids_;
  Place place_;
  std::vector<Vector3d> positions_;
};

/// A waving sheet in steps of float, and a second one on it or half a cell's fortieth above.
std::unique_ptr<PlayedScene> layers(double gap) {
  const auto place = [gap](const Vector3d& rest, std::size_t object, double frame) -> Vector3d {
    const double height = 0.05 * wave(2 * rest.x()) * wave(1 + 1.5 * rest.y());
    const double swell = 0.002 * wave(0.25 * frame + 3 * rest.x());
    const double lift = object == 1 ? gap : 0;
    return Vector3d(rest.x(), rest.y(), height + swell + lift).cast<float>().cast<double>();
  };
  return std::make_unique<CopiesScene>(settings_of(0.001, 0.01), mesh_of(fine_sheet(49, 0.02)), 2, place);
}

/// A sheet that bends further in every frame, and its copy on it or a thousandth beside it.
std::unique_ptr<PlayedScene> twins(double apart) {
  const auto place = [apart](const Vector3d& rest, std::size_t object, double frame) -> Vector3d {
    const double height = 0.1 * wave(4 * rest.x()) * wave(1 + 2.6 * rest.y());
    const double swell = 0.001 * frame * wave(6 * rest.x() + frame / 3);
    const double offset = object == 1 ? apart : 0;
    return {rest.x() + offset, rest.y(), height + swell + offset};
  };
  return std::make_unique<CopiesScene>(settings_of(0.01, 0), mesh_of(fine_sheet(21, 0.05)), 2, place);
}

/// A sphere that swells, and its copy in the same place or shifted by a thousandth.
std::unique_ptr<PlayedScene> spheres(double apart) {
  const auto place = [apart](const Vector3d& rest, std::size_t object, double frame) -> Vector3d {
    const double size = 1 + 0.01 * wave(frame / 3 + rest.z());
    return size * rest + (object == 1 ? apart : 0) * Vector3d(1, 0.7, 0.3);
  };
  return std::make_unique<CopiesScene>(settings_of(0.001, 0.01), mesh_on_grid(models::sphere(64, 50)), 2,
                                       place);
}

/// A box of 866 vertices that slides over another, flush with it or a little above it.
std::unique_ptr<PlayedScene> boxes(double gap) {
  models::MeshData data;
  constexpr std::uint32_t cells = 12;
  std::vector<std::uint32_t> number((cells + 1) * (cells + 1) * (cells + 1), ~std::uint32_t{0});
  const auto vertex = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint32_t& known = number[(z * (cells + 1) + y) * (cells + 1) + x];
    if (known == ~std::uint32_t{0}) {
      known = static_cast<std::uint32_t>(data.positions.size());
      data.positions.push_back(Vector3d(x, y, z) / cells);
    }
    return known;
  };
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i)
      for (const std::uint32_t side : {std::uint32_t{0}, cells}) {
        const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
          if (side == 0) std::swap(b, d);
          data.add_face({a, b, c});
          data.add_face({a, c, d});
        };
        quad(vertex(i, j, side), vertex(i + 1, j, side), vertex(i + 1, j + 1, side), vertex(i, j + 1, side));
        quad(vertex(side, i, j), vertex(side, i + 1, j), vertex(side, i + 1, j + 1), vertex(side, i, j + 1));
        quad(vertex(j, side, i), vertex(j, side, i + 1), vertex(j + 1, side, i + 1), vertex(j + 1, side, i));
      }
  const auto place = [gap](const Vector3d& rest, std::size_t object, double frame) -> Vector3d {
    return object == 0 ? rest : Vector3d(rest + Vector3d(0.0137 * (frame + 1), 0.0071 * frame, 1 + gap));
  };
  SceneSettings settings = settings_of(0.05, 0.1);
  settings.detail = ContactDetail::closest;
  return std::make_unique<CopiesScene>(std::move(settings), mesh_of(data), 2, place);
}

/// Bricks in a wall that moves up, each as it is or turned a little.
class WallScene : public PlayedScene {
 public:
  explicit WallScene(double degrees) : degrees_(degrees) {}

  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.002, 0.01); }
  void advance(Scene& scene, std::size_t frame) override {
    for (int row = 0; row < 10; ++row)
      for (int column = 0; column < 10; ++column) {
        if (frame == 0) {
          ObjectSettings settings;
          settings.motion = Motion::rigid;
          ids_.push_back(scene.add(mesh_, settings));
        }
        const int brick = 10 * row + column;
        Eigen::Isometry3d pose =
            turn(degrees_ * ((7 * column + row) % 5 - 2), degrees_ * ((3 * column + 5 * row) % 7 - 3));
        pose.translation() = Vector3d(column + 0.5 * (row % 2), static_cast<double>(frame), row);
        scene.set_pose(ids_[static_cast<std::size_t>(brick)], pose);
      }
  }

 private:
  /// About x and then z, by small angles, of which sine and cosine are the first terms of their series.
  static Eigen::Isometry3d turn(double about_x, double about_z) {
    const auto rotation = [](double degrees, int first, int second) {
      const double angle = degrees * 0.017453292519943295;
      const double sine = angle * (1 - angle * angle / 6 * (1 - angle * angle / 20));
      const double cosine = 1 - angle * angle / 2 * (1 - angle * angle / 12 * (1 - angle * angle / 30));
      Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
      matrix(first, first) = matrix(second, second) = cosine;
      matrix(first, second) = -sine;
      matrix(second, first) = sine;
      return matrix;
    };
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation(about_z, 0, 1) * rotation(about_x, 1, 2);
    return pose;
  }

  double degrees_;
  std::shared_ptr<const Mesh> mesh_ = mesh_of(models::box({1, 1, 1}, models::Faces::triangles));
  std::vector<ObjectId> ids_;
};

/// A hundred small spheres in one place.
std::unique_ptr<PlayedScene> copies() {
  const auto place = [](const Vector3d& rest, std::size_t, double frame) -> Vector3d {
    return (1 + 0.01 * wave(frame / 3 + rest.z())) * rest;
  };
  return std::make_unique<CopiesScene>(settings_of(0.01, 0), mesh_on_grid(models::sphere(10, 5)), 100, place);
}

/// A character of 286 vertices and its copy in one place, of which only what pierces is a contact.
std::unique_ptr<PlayedScene> character() {
  const auto place = [](const Vector3d& rest, std::size_t, double frame) -> Vector3d {
    const Vector3d bent = rest + Vector3d(0.05 * wave(frame / 3 + 2 * rest.z()), 0, 0);
    return bent.cast<float>().cast<double>();
  };
  return std::make_unique<CopiesScene>(settings_of(0, 0), mesh_on_grid(models::torus(26, 11, 0.7, 0.3)), 2,
                                       place);
}

}  // namespace

std::vector<std::string_view> coinciding_scene_names() {
  return {"layers_on",  "layers_off",  "wall_touching", "wall_turned", "twins_on", "twins_off",
          "spheres_on", "spheres_off", "boxes_flush",   "boxes_apart", "copies",   "character"};
}

std::unique_ptr<PlayedScene> make_coinciding_scene(std::string_view name) {
  if (name == "layers_on") return layers(0);
  if (name == "layers_off") return layers(0.0005);
  if (name == "wall_touching") return std::make_unique<WallScene>(0);
  if (name == "wall_turned") return std::make_unique<WallScene>(0.05);
  if (name == "twins_on") return twins(0);
  if (name == "twins_off") return twins(0.001);
  if (name == "spheres_on") return spheres(0);
  if (name == "spheres_off") return spheres(0.001);
  if (name == "boxes_flush") return boxes(0);
  if (name == "boxes_apart") return boxes(0.02);
  if (name == "copies") return copies();
  if (name == "character") return character();
  return nullptr;
}

}  // namespace graze::scenes
