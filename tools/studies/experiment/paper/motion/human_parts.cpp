#include "experiment/paper/motion/human_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>

#include "mean_edge_length.hpp"

namespace graze::tools {
namespace {

constexpr std::array<const char*, 6> part_names = {"head",      "body",     "left_arm",
                                                   "right_arm", "left_leg", "right_leg"};

/// `place` is a place of the human of graze_models, which is 2 high and stands about the origin.
std::size_t part_at(const Eigen::Vector3d& place) {
  const double side = std::abs(place.x());
  if (place.z() > 0.74) return 0;
  if (side > 0.21 && place.z() > -0.25) return place.x() > 0 ? 2 : 3;
  if (place.z() < -0.02) return place.x() > 0 ? 4 : 5;
  return 1;
}

double half_height(const models::MeshData& human) {
  double half = 0;
  for (const Eigen::Vector3d& position : human.positions) half = std::max(half, std::abs(position.z()));
  return half;
}

/// Some faces of an object, with the vertices they use.
class Part {
 public:
  explicit Part(const RecordedObject& whole) : whole_(whole) {}

  void add_face(std::span<const std::uint32_t> corners) {
    for (const std::uint32_t corner : corners) {
      const auto [entry, is_new] =
          numbers_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
      if (is_new) {
        mesh_.positions.push_back(whole_.rest.positions[corner]);
        vertices_.push_back(corner);
      }
      mesh_.corners.push_back(entry->second);
    }
    mesh_.corner_counts.push_back(static_cast<std::uint32_t>(corners.size()));
  }

  [[nodiscard]] RecordedObject object(const std::string& name, std::uint64_t group) const {
    RecordedObject part{whole_.name + "_" + name, name, whole_.kind_id, group, mesh_, nullptr, {}};
    part.mesh = std::make_shared<const Mesh>(
        Mesh::from_polygons(mesh_.positions, mesh_.corners, mesh_.corner_counts));
    for (const std::vector<float>& frame : whole_.frames) {
      std::vector<float>& positions = part.frames.emplace_back();
      for (const std::size_t vertex : vertices_)
        positions.insert(positions.end(), {frame[3 * vertex], frame[3 * vertex + 1], frame[3 * vertex + 2]});
    }
    return part;
  }

 private:
  const RecordedObject& whole_;
  models::MeshData mesh_;
  std::vector<std::size_t> vertices_;  ///< of the whole, by the part's numbers
  std::map<std::uint32_t, std::uint32_t> numbers_;
};

void add_parts(const RecordedObject& human, std::uint64_t group, RecordedMotion& motion) {
  const double unit = half_height(human.rest);
  std::vector<Part> parts(part_names.size(), Part(human));
  auto corner = human.rest.corners.begin();
  for (const std::uint32_t count : human.rest.corner_counts) {
    const std::span<const std::uint32_t> corners(corner, corner + count);
    corner += count;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t vertex : corners) middle += human.rest.positions[vertex] / (count * unit);
    parts[part_at(middle)].add_face(corners);
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    motion.objects.push_back(parts[i].object(part_names[i], group));
}

RecordedMotion thinned_out(RecordedMotion motion, std::size_t every) {
  for (RecordedObject& object : motion.objects) {
    std::vector<std::vector<float>> kept;
    for (std::size_t frame = 0; frame < object.frames.size(); ++frame)
      if ((object.frames.size() - 1 - frame) % every == 0) kept.push_back(std::move(object.frames[frame]));
    object.frames = std::move(kept);
  }
  return motion;
}

}  // namespace

RecordedMotion with_humans_in_parts(const RecordedMotion& motion, std::size_t every) {
  const RecordedMotion kept = thinned_out(motion, every);
  RecordedMotion result;
  result.name = motion.name + "_parts";
  std::uint64_t group = 0;
  for (const RecordedObject& object : kept.objects) {
    if (object.kind == "human")
      add_parts(object, ++group, result);
    else
      result.objects.push_back(object);
  }
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const RecordedObject& object : result.objects) meshes.push_back(object.mesh);
  result.mean_edge_length = mean_edge_length(meshes);
  return result;
}

}  // namespace graze::tools
