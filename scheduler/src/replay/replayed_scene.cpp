#include "replay/replayed_scene.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace graze {
namespace {

/// A coordinate that a scene refuses for this reason.
double bad_coordinate(DiagnosticKind problem) {
  return problem == DiagnosticKind::too_large ? std::numeric_limits<double>::max()
                                              : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

// ---- What is asked of it

ReplayedScene::Object* ReplayedScene::find(ObjectId recorded) {
  const auto found = recorded_.find(recorded);
  return found == recorded_.end() || objects_.at(found->second).is_removed ? nullptr
                                                                           : &objects_.at(found->second);
}

ObjectId ReplayedScene::id_of(ObjectId recorded) {
  const Object* const object = find(recorded);
  return object == nullptr ? ObjectId() : object->object.id;
}

const ReplayedScene::Object& ReplayedScene::of(ObjectId id) const {
  return objects_.at(replayed_.at(id));
}

ObjectId ReplayedScene::recorded_id(ObjectId id) const {
  const auto found = replayed_.find(id);
  return found == replayed_.end() ? ObjectId() : objects_.at(found->second).recorded;
}

std::string ReplayedScene::name_of(ObjectId recorded) const {
  const auto found = recorded_.find(recorded);
  if (found == recorded_.end()) return "an object that the replay does not have";
  const std::string& name = objects_.at(found->second).object.settings.name;
  return name.empty() ? "object " + std::to_string(found->second) : "\"" + name + "\"";
}

std::vector<ReplayObject> ReplayedScene::objects() const {
  std::vector<ReplayObject> all;
  for (const auto& [serial, object] : objects_)
    if (!object.is_removed) all.push_back(object.object);
  return all;
}

void ReplayedScene::read_positions(ObjectId id, std::vector<Eigen::Vector3d>& positions) const {
  const Object& object = of(id);
  const auto rest = object.object.mesh->rest();
  positions.assign(rest.begin(), rest.end());
  if (object.object.settings.motion == Motion::deformable) {
    if (object.positions.is_empty()) return;
    const PositionView view = object.positions.view();
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) positions[vertex] = view[vertex];
    return;
  }
  const auto& pose = object.pose;
  for (Eigen::Vector3d& point : positions) {
    const Eigen::Vector3d from = point;
    for (Eigen::Index row = 0; row < 3; ++row) {
      const double* const r = &pose[static_cast<std::size_t>(4 * row)];
      point[row] = ((r[0] * from.x() + r[1] * from.y()) + r[2] * from.z()) + r[3];
    }
  }
}

std::array<double, 12> ReplayedScene::pose(ObjectId id) const {
  return of(id).pose;
}

void ReplayedScene::forget_removed() {
  for (const ObjectId recorded : removed_) {
    const std::uint64_t serial = recorded_.at(recorded);
    replayed_.erase(objects_.at(serial).object.id);
    objects_.erase(serial);
    recorded_.erase(recorded);
  }
  removed_.clear();
}

// ---- What it is given

void ReplayedScene::take(const AddRecord& record) {
  Object object;
  object.recorded = record.object;
  object.object = {{}, record.serial, reader_.mesh(record.mesh), record.settings};
  object.object.id = scene_.add(object.object.mesh, record.settings);
  recorded_[record.object] = record.serial;
  replayed_[object.object.id] = record.serial;
  objects_[record.serial] = std::move(object);
}

void ReplayedScene::take(const ReplaceRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  std::shared_ptr<const Mesh> mesh = reader_.mesh(record.mesh);
  scene_.replace_mesh(object->object.id, mesh, record.new_of_old, record.face_groups);
  object->object.mesh = std::move(mesh);
  object->object.settings.face_groups = record.face_groups;
  object->positions.clear();  // the binding has ended with this call
}

void ReplayedScene::take(const RemoveObject& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  scene_.remove(object->object.id);
  filters_.forget(object->object.id);
  object->is_removed = true;
  removed_.push_back(record.object);
}

void ReplayedScene::take(const SetPose& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  object->pose = record.rows;
  scene_.set_pose_rows(object->object.id, record.rows);
}

void ReplayedScene::take(const RefusePose& record) {
  staging_.repeat(RefusePose{{id_of(record.problem.object), record.problem.kind, record.problem.message}});
}

void ReplayedScene::take(const SettlePose& record) {
  if (const Object* const object = find(record.object)) staging_.repeat(SettlePose{object->object.id});
}

void ReplayedScene::take(const PositionsRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  scene_.set_positions(object->object.id, record.positions, record.max_displacement);
  // The binding has ended with this call, so the memory may be written.
  object->positions.take(record.positions);
}

void ReplayedScene::take(const BindRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  KeptPositions memory = object->positions.in_form(object->object.mesh->rest(), record.is_double);
  scene_.bind_positions(object->object.id, memory.view(), record.policy);
  object->positions = std::move(memory);  // only now may the memory of an earlier binding go
  object->policy = record.policy;
  object->is_told = true;
}

/// The memory stays where it is, since a binding has made room for positions of its form.
///
/// The recorded scene has read it in this step. The call that told it so may have come before the keyframe at
/// which the replay began, where promises kept the object unread. Then this scene is told now.
void ReplayedScene::take(const MemoryRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  object->positions.take(record.positions);
  const bool was_told = std::exchange(object->is_told, false);
  if (!was_told && object->policy == BindPolicy::when_told) scene_.positions_changed(object->object.id);
}

/// Positions of another form than before come only where there is no binding, and say nothing then.
void ReplayedScene::take(const UnbindRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  const PositionView before = object->positions.view();
  const bool has_form =
      before.size() == record.positions.size() && before.is_double() == record.positions.is_double();
  if (record.positions.size() > 0 && has_form) object->positions.take(record.positions);
  if (record.problem != DiagnosticKind::stale_id) object->positions.fill(bad_coordinate(record.problem));
  scene_.unbind_positions(object->object.id);
}

void ReplayedScene::take(const SetRule& record) {
  if (record.rule.range) least_range_ = std::min(least_range_, *record.rule.range);
  filters_.take(record);
  scene_.set_rule(record.kind_a, record.kind_b, record.rule);
}

void ReplayedScene::take(const PositionsChanged& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  object->is_told = true;
  scene_.positions_changed(object->object.id, record.max_displacement);
}

void ReplayedScene::take(const IgnorePair& record) {
  const Object* const a = find(record.a);
  const Object* const b = find(record.b);
  if (a == nullptr || b == nullptr) return;
  const IgnorePair call{a->object.id, b->object.id, record.ignored};
  filters_.take(call);
  staging_.repeat(call);
}

void ReplayedScene::take(const IgnoreGroups& record) {
  const Object* const a = find(record.a);
  const Object* const b = find(record.b);
  if (a == nullptr || b == nullptr) return;
  const IgnoreGroups call{a->object.id, record.group_a, b->object.id, record.group_b, record.ignored};
  filters_.take(call);
  staging_.repeat(call);
}

void ReplayedScene::take(const MarkTeleport& record) {
  if (const Object* const object = find(record.object)) staging_.repeat(MarkTeleport{object->object.id});
}

void ReplayedScene::take(const Diagnostic& record) {
  staging_.repeat(Diagnostic{id_of(record.object), record.kind, record.message});
}

}  // namespace graze
