#include "page/page_objects.hpp"

#include <algorithm>
#include <cstring>
#include <graze/error.hpp>

namespace graze::io {
namespace {

constexpr std::array<double, 12> pose_at_rest = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

SharedPositions shared_copy(const PositionView& positions) {
  auto copy = std::make_shared<std::vector<Eigen::Vector3d>>();
  copy->reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) copy->push_back(positions[i]);
  return copy;
}

bool has_these_bits(const std::vector<Eigen::Vector3d>& known, const PositionView& positions) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Eigen::Vector3d point = positions[i];
    if (std::memcmp(point.data(), known[i].data(), sizeof point) != 0) return false;
  }
  return true;
}

}  // namespace

void PageObjects::add(ObjectId id, const PageObject& object, std::size_t mesh_number, std::uint64_t frame) {
  const std::size_t index = objects_.size();
  WrittenObject written;
  written.before = index_of(id);
  if (written.before && !objects_[*written.before].removed)
    throw Error("page: the object \"" + object.name + "\" was added before; remove it first");
  indices_[id] = static_cast<std::uint32_t>(index);
  written.name = object.name;
  written.motion = object.motion;
  written.solid = object.solid;
  written.swept = object.swept;
  written.settings = object.settings;
  written.mesh_number = mesh_number;
  written.user_data = object.user_data;
  written.added = frame;
  written.mesh = object.mesh;
  written.latest.pose = pose_at_rest;
  if (object.motion == Motion::deformable)
    written.latest.positions = shared_copy(PositionView(object.mesh->rest()));
  written.shown = written.latest;
  objects_.push_back(std::move(written));
  alive_.push_back(index);
}

void PageObjects::remove(ObjectId id, std::uint64_t frame) {
  objects_[present(id)].removed = frame;
}

void PageObjects::set_positions(ObjectId id, const PositionView& positions) {
  const std::size_t index = present(id);
  WrittenObject& object = objects_[index];
  if (object.motion != Motion::deformable)
    throw Error("page: positions were given for \"" + object.name + "\", which is not deformable");
  const SharedPositions& known = object.latest.positions;
  if (positions.size() != known->size())
    throw Error("page: \"" + object.name + "\" has " + std::to_string(known->size()) + " vertices, not " +
                std::to_string(positions.size()));
  if (has_these_bits(*known, positions)) return;
  object.latest.positions = shared_copy(positions);
  note_motion(index);
}

void PageObjects::set_pose(ObjectId id, const std::array<double, 12>& rows) {
  const std::size_t index = present(id);
  WrittenObject& object = objects_[index];
  if (object.motion == Motion::deformable)
    throw Error("page: a pose was given for \"" + object.name + "\", which is deformable");
  if (std::memcmp(object.latest.pose.data(), rows.data(), sizeof rows) == 0) return;
  object.latest.pose = rows;
  note_motion(index);
}

std::optional<std::uint32_t> PageObjects::index_of(ObjectId id) const {
  const auto found = indices_.find(id);
  return found == indices_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::uint32_t> PageObjects::index_of(ObjectId id, std::uint64_t frame) const {
  auto index = index_of(id);
  while (index && objects_[*index].added > frame && objects_[*index].before) index = objects_[*index].before;
  return index;
}

std::size_t PageObjects::present(ObjectId id) const {
  const auto index = index_of(id);
  if (!index || objects_[*index].removed)
    throw Error("page: the id names no object that is there; add the object first");
  return *index;
}

void PageObjects::note_motion(std::size_t index) {
  WrittenObject& object = objects_[index];
  if (!object.has_moved) moved_.push_back(index);
  object.has_moved = true;
}

void PageObjects::note_error(std::size_t index, double error) {
  objects_[index].position_error = std::max(objects_[index].position_error, error);
}

void PageObjects::forget_removed(const std::function<bool(std::uint64_t)>& is_past) {
  std::erase_if(alive_, [&](std::size_t index) {
    WrittenObject& object = objects_[index];
    if (!object.removed || !is_past(*object.removed)) return false;
    object.mesh.reset();
    object.shown = {};
    object.latest = {};
    return true;
  });
}

std::vector<std::size_t> PageObjects::take_moved() {
  for (const std::size_t index : moved_) objects_[index].has_moved = false;
  return std::exchange(moved_, {});
}

std::pair<std::size_t, bool> PageMeshes::number_of(const std::shared_ptr<const Mesh>& mesh) {
  const auto [place, is_new] = numbers_.try_emplace(mesh, counts_.size());
  if (is_new) counts_.push_back(page_counts_of(*mesh));
  return {place->second, is_new};
}

}  // namespace graze::io
