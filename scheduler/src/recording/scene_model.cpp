#include "recording/scene_model.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace graze {
namespace {

std::span<const std::byte> bytes_of(const PositionView& packed) {
  const std::size_t number = packed.is_double() ? sizeof(double) : sizeof(float);
  return {static_cast<const std::byte*>(packed.data()), 3 * number * packed.size()};
}

std::pair<ObjectId, ObjectId> ordered(ObjectId a, ObjectId b) {
  return b < a ? std::pair(b, a) : std::pair(a, b);
}

}  // namespace

PositionView KeptPositions::view() const {
  if (count_ == 0) return {};
  const void* const first = bytes_.bytes().data();
  return is_double_ ? PositionView(static_cast<const double*>(first), count_)
                    : PositionView(static_cast<const float*>(first), count_);
}

bool KeptPositions::is_same(const PositionView& packed) const {
  if (packed.size() != count_ || count_ == 0 || packed.is_double() != is_double_) return false;
  return std::memcmp(bytes_of(packed).data(), bytes_.bytes().data(), bytes_.size()) == 0;
}

void KeptPositions::take(const PositionView& packed) {
  count_ = 0;  // until they are there: it may throw
  bytes_.clear();
  bytes_.append(bytes_of(packed));
  count_ = packed.size();
  is_double_ = packed.is_double();
}

KeptPositions KeptPositions::in_form(std::span<const Eigen::Vector3d> rest, bool is_double) const {
  KeptPositions made;
  if (count_ > 0 && is_double_ == is_double) {
    made.take(view());
  } else if (is_double) {
    made.take(PositionView(rest));
  } else {
    std::vector<Eigen::Vector3f> floats;
    floats.reserve(rest.size());
    for (const Eigen::Vector3d& point : rest) floats.emplace_back(point.cast<float>());
    made.take(PositionView(floats));
  }
  return made;
}

void KeptPositions::fill(double coordinate) {
  const auto fill_as = [&]<typename Number>(Number value) {
    for (std::size_t at = 0; at < bytes_.size(); at += sizeof(Number))
      std::memcpy(bytes_.bytes().data() + at, &value, sizeof(Number));
  };
  if (is_double_)
    fill_as(coordinate);
  else
    fill_as(static_cast<float>(coordinate));
}

const ModelObject* SceneModel::find(ObjectId id) const {
  const auto found = objects_.find(id);
  return found == objects_.end() ? nullptr : &found->second;
}

void SceneModel::apply(const Record& record) {
  std::visit([this](const auto& one) { take(one); }, record);
}

bool SceneModel::holds(const MemoryRecord& record) const {
  const ModelObject* const object = find(record.object);
  return object != nullptr && object->positions.is_same(record.positions);
}

void SceneModel::take(const AddRecord& record) {
  ModelObject& object = objects_[record.object];
  object = ModelObject();
  object.serial = record.serial;
  object.mesh = record.mesh;
  object.settings = record.settings;
  by_serial_[object.serial] = record.object;
  of_frame_.push_back(record.object);
}

void SceneModel::take(const ReplaceRecord& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  object->mesh = record.mesh;
  object->settings.face_groups = record.face_groups;
  object->positions.clear();
  object->binding.reset();
  if (object->settings.motion == Motion::deformable) object->frozen_by.reset();
  object->was_seen = false;
  of_frame_.push_back(record.object);
}

void SceneModel::take(const RemoveObject& record) {
  const ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  by_serial_.erase(object->serial);
  objects_.erase(record.object);
  std::erase_if(ignored_, [&](const auto& pair) {
    return pair.first == record.object || pair.second == record.object;
  });
  std::erase_if(ignored_groups_, [&](const auto& groups) {
    return groups.first.object == record.object || groups.second.object == record.object;
  });
}

void SceneModel::take(const SetPose& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  if (!std::exchange(object->is_posed, true)) {
    object->last_pose = object->pose;
    of_frame_.push_back(record.object);
  }
  object->pose = record.rows;
  object->frozen_by.reset();
}

/// A pose of the same frame is not accepted either.
void SceneModel::take(const RefusePose& record) {
  ModelObject* const object = find(record.problem.object);
  if (object == nullptr) return;
  if (object->is_posed) object->pose = object->last_pose;
  object->frozen_by = record;
}

void SceneModel::take(const SettlePose& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  object->is_posed = false;
  object->was_seen = true;
}

void SceneModel::end_frame() {
  for (const ObjectId id : of_frame_) {
    ModelObject* const object = find(id);
    if (object == nullptr) continue;
    object->is_posed = false;
    object->was_seen = object->was_seen || !object->frozen_by;
  }
  of_frame_.clear();
}

void SceneModel::take(const PositionsRecord& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  object->binding.reset();
  object->frozen_by.reset();
  object->positions.take(record.positions);
}

void SceneModel::take(const BindRecord& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  object->binding = record;
  object->frozen_by.reset();
  // Until its memory is told, it stands at rest, unless positions of that form are known.
  if (object->positions.view().is_double() != record.is_double) object->positions.clear();
}

void SceneModel::take(const MemoryRecord& record) {
  if (ModelObject* const object = find(record.object)) object->positions.take(record.positions);
}

void SceneModel::take(const UnbindRecord& record) {
  ModelObject* const object = find(record.object);
  if (object == nullptr) return;
  const bool has_reason = record.problem != DiagnosticKind::stale_id;
  // A call that freezes an object as it was before a keyframe gives the reason alone.
  const bool freezes = object->binding && has_reason && record.positions.size() == 0;
  object->binding.reset();
  if (record.positions.size() > 0) object->positions.take(record.positions);
  if (!record.is_frozen && !freezes) return;
  object->frozen_by = UnbindRecord{.object = record.object,
                                   .is_frozen = true,
                                   .problem = has_reason ? record.problem : DiagnosticKind::not_finite,
                                   .positions = {}};
  object->positions.clear();
}

void SceneModel::take(const IgnorePair& record) {
  if (record.ignored)
    ignored_.insert(ordered(record.a, record.b));
  else
    ignored_.erase(ordered(record.a, record.b));
}

void SceneModel::take(const IgnoreGroups& record) {
  const std::pair<GroupOf, GroupOf> groups =
      std::minmax(GroupOf{record.a, record.group_a}, GroupOf{record.b, record.group_b});
  if (record.ignored)
    ignored_groups_.insert(groups);
  else
    ignored_groups_.erase(groups);
}

void SceneModel::take(const SetRule& record) {
  rules_[std::minmax(record.kind_a, record.kind_b)] = record.rule;
}

}  // namespace graze
