#include "scenes/inside_scenes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "scenes/scene_parts.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

/// The size of the body and its middle.
struct Place {
  std::string_view name;
  double size;
  std::array<double, 3> middle;
};
constexpr std::array<Place, 3> places = {{{"inside_middle", 0.5, {0, 0, 0}},
                                          {"inside_aside", 0.5, {0.3, 0.1, 0.05}},
                                          {"inside_near", 0.95, {0.003, 0.002, 0.001}}}};

const Place& place_of(std::string_view name) {
  const auto* const found =
      std::find_if(places.begin(), places.end(), [&](const Place& place) { return place.name == name; });
  if (found == places.end()) throw std::out_of_range("no scene " + std::string(name));
  return *found;
}

/// Swells by some thousandths, more on one side than on the other.
Vector3d swollen(const Vector3d& rest, double phase) {
  return rest * (1 + 0.002 * rest.z() * (phase - rest.x()) + 0.001 * phase * rest.y());
}

}  // namespace

InsideScene::InsideScene(std::string_view name, std::uint32_t rings)
    : size_(place_of(name).size), middle_(place_of(name).middle.data()) {
  models::MeshData data = models::sphere(2 * rings, rings);
  for (std::size_t i = 0; i < data.corners.size(); i += 3)
    triangles_.push_back({data.corners[i], data.corners[i + 1], data.corners[i + 2]});
  mesh_ = mesh_on_grid(std::move(data));
}

SceneSettings InsideScene::settings() const {
  SceneSettings settings = settings_of(0.01, 0.05);
  settings.detail = ContactDetail::nearest;
  return settings;
}

void InsideScene::advance(Scene& scene, std::size_t frame) {
  const double phase = 0.5 - 0.25 * static_cast<double>(frame % 4);
  const Vector3d shift(0.0004 * static_cast<double>(frame % 5), 0.0003 * static_cast<double>(frame % 7), 0);
  for (std::size_t object = 0; object < 2; ++object) {
    if (frame == 0) {
      ObjectSettings settings;
      settings.solid = object == 0;
      ids_[object] = scene.add(mesh_, settings);
    }
    positions_[object].clear();
    for (const Vector3d& rest : mesh_->rest())
      positions_[object].push_back(object == 0 ? swollen(rest, phase)
                                               : Vector3d(size_ * swollen(rest, -phase) + middle_ + shift));
    scene.set_positions(ids_[object], positions_[object]);
  }
}

std::vector<std::string_view> inside_scene_names() {
  std::vector<std::string_view> names;
  for (const Place& place : places) names.push_back(place.name);
  return names;
}

std::unique_ptr<InsideScene> make_inside_scene(std::string_view name, bool are_small) {
  const std::vector<std::string_view> names = inside_scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) return nullptr;
  return std::make_unique<InsideScene>(name, are_small ? 24 : 64);
}

}  // namespace graze::scenes
