#include <atomic>
#include <exception>
#include <graze/error.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <utility>

#include "core/base/floating_point_scope.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/pair_query.hpp"
#include "step/scene_state.hpp"

namespace graze {
namespace {

/// Prepares what pairs of an object will need of its mesh, so that no step waits for it.
void prepare(const IndexedMesh& mesh, const ObjectSettings& object, const SceneSettings& scene) {
  const ContactDetail detail = scene.detail;
  if (wants_blocks(detail, scene.accuracy.mode())) mesh.prepare_for(IndexedMesh::Use::blocks);
  if (scene.accuracy.mode() == AccuracyMode::paper) mesh.prepare_for(IndexedMesh::Use::neighbours);
  if (detail != ContactDetail::none)
    mesh.prepare_for(is_about_vertices(detail) ? IndexedMesh::Use::normals_of_points
                                               : IndexedMesh::Use::normals);
  if (scene.ways_out && !is_about_vertices(detail)) mesh.prepare_for(IndexedMesh::Use::faces_of_edges);
  if (detail == ContactDetail::nearest) mesh.prepare_for(IndexedMesh::Use::sides_of_edges);
  if (object.solid) mesh.prepare_for(IndexedMesh::Use::neighbours);
  if (object.motion != Motion::deformable) mesh.prepare_for(IndexedMesh::Use::poses);
}

void begin_stepping(const Stepping& stepping) {
  if (stepping->exchange(true, std::memory_order_acquire))
    throw Error("scene: a step of this scene is already running on another thread");
}

/// Clears the flag when it is destroyed.
class SteppingEnd {
 public:
  explicit SteppingEnd(Stepping stepping) : stepping_(std::move(stepping)) {}
  ~SteppingEnd() {
    if (stepping_ == nullptr) return;
    stepping_->store(false, std::memory_order_release);
    stepping_->notify_all();
  }
  SteppingEnd(const SteppingEnd&) = delete;
  SteppingEnd& operator=(const SteppingEnd&) = delete;
  /// Leaves clearing the flag to another object.
  void leave() noexcept { stepping_ = nullptr; }

 private:
  Stepping stepping_;
};

}  // namespace

Scene::Scene(const SceneSettings& settings, std::shared_ptr<TaskScheduler> scheduler) {
  const FloatingPointScope scope;
  state_ = std::make_unique<State>(settings, std::move(scheduler));
}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const SceneSettings& Scene::settings() const {
  return state_->settings;
}

ObjectId Scene::add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
  if (mesh != nullptr) prepare(indexed(*mesh), settings, state_->settings);
  return state_->staging.add(std::move(mesh), settings);
}
void Scene::replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                         std::span<const std::uint32_t> new_of_old,
                         std::span<const std::uint8_t> face_groups) {
  if (const auto named = state_->staging.find(object); named && mesh != nullptr)
    prepare(indexed(*mesh), named->settings, state_->settings);
  state_->staging.replace_mesh(object, std::move(mesh), new_of_old, face_groups);
}
void Scene::remove(ObjectId object) {
  state_->staging.remove(object);
}
std::size_t Scene::object_count() const {
  return state_->staging.object_count();
}
bool Scene::contains(ObjectId object) const {
  return state_->staging.contains(object);
}
std::shared_ptr<const Mesh> Scene::mesh(ObjectId object) const {
  const auto named = state_->staging.find(object);
  return named ? named->mesh.get().mesh : nullptr;
}
ObjectSettings Scene::object_settings(ObjectId object) const {
  const auto named = state_->staging.find(object);
  return named ? named->settings : ObjectSettings{};
}
std::string Scene::name(ObjectId object) const {
  const auto named = state_->staging.find(object);
  return named ? named->settings.name : std::string();
}

void Scene::set_pose_rows(ObjectId object, const std::array<double, 12>& rows) {
  state_->staging.set_pose(object, rows);
}
void Scene::set_pose_rows(ObjectId object, const std::array<double, 12>& rows, Teleport) {
  state_->staging.set_pose(object, rows, true);
}
void Scene::set_pose_matrix(ObjectId object, const std::array<double, 16>& rows) {
  state_->staging.set_pose(object, rows);
}
void Scene::set_pose_matrices(std::span<const ObjectId> objects, std::span<const double> matrices) {
  state_->staging.set_poses(objects, matrices);
}
void Scene::set_pose_matrices(std::span<const ObjectId> objects, std::span<const double> matrices, Teleport) {
  state_->staging.set_poses(objects, matrices, true);
}
void Scene::set_positions(ObjectId object, PositionView positions, double max_displacement) {
  state_->staging.set_positions(object, positions, max_displacement);
}
void Scene::set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                          double max_displacement) {
  state_->staging.set_positions(objects, positions, max_displacement);
}
void Scene::set_positions(ObjectId object, PositionView positions, Teleport) {
  state_->staging.set_positions(object, positions, any_displacement, true);
}
void Scene::set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                          Teleport) {
  state_->staging.set_positions(objects, positions, any_displacement, true);
}
void Scene::bind_positions(ObjectId object, PositionView positions, BindPolicy policy) {
  state_->staging.bind_positions(object, positions, policy);
}
void Scene::bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                           BindPolicy policy) {
  state_->staging.bind_positions(objects, positions, policy);
}
void Scene::unbind_positions(ObjectId object) {
  state_->staging.unbind_positions(object);
}
void Scene::positions_changed(ObjectId object, double max_displacement) {
  state_->staging.positions_changed(object, max_displacement);
}
void Scene::positions_changed(std::span<const ObjectId> objects, double max_displacement) {
  state_->staging.positions_changed(objects, max_displacement);
}
void Scene::positions_changed(std::span<const ObjectId> objects, std::span<const double> max_displacements) {
  state_->staging.positions_changed(objects, max_displacements);
}
void Scene::positions_changed(ObjectId object, Teleport) {
  state_->staging.positions_changed(object, any_displacement, true);
}
void Scene::positions_changed(std::span<const ObjectId> objects, Teleport) {
  state_->staging.positions_changed(objects, any_displacement, true);
}
void Scene::ignore(ObjectId a, ObjectId b) {
  state_->staging.set_ignored(a, b, true);
}
void Scene::watch(ObjectId a, ObjectId b) {
  state_->staging.set_ignored(a, b, false);
}
void Scene::ignore(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b) {
  state_->staging.set_ignored(a, group_a, b, group_b, true);
}
void Scene::watch(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b) {
  state_->staging.set_ignored(a, group_a, b, group_b, false);
}
void Scene::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  state_->staging.set_rule(kind_a, kind_b, rule);
}
void Scene::reserve(const SceneCapacity& capacity) {
  state_->staging.reserve(capacity);
}

ReportHandle Scene::step(std::uint64_t tag) {
  begin_stepping(state_->stepping);
  const SteppingEnd end(state_->stepping);
  state_->stepper.collect_calls();
  return state_->stepper.run(tag);
}

void Scene::step_async(std::uint64_t tag) {
  begin_stepping(state_->stepping);
  SteppingEnd unless_started(state_->stepping);
  State* const state = state_.get();
  state->stepper.collect_calls();
  state->stepper.start([state, tag] {
    // After this the scene may be gone.
    const SteppingEnd end(state->stepping);
    state->problem = nullptr;
    try {
      (void)state->stepper.run(tag);
    } catch (...) {
      state->problem = std::current_exception();
    }
  });
  unless_started.leave();
}

bool Scene::is_stepping() const {
  return state_->stepping->load(std::memory_order_acquire);
}

ReportHandle Scene::wait() {
  wait_while(*state_->stepping, true);
  if (state_->problem) std::rethrow_exception(std::exchange(state_->problem, nullptr));
  return latest_report();
}

ReportHandle Scene::latest_report() const {
  return state_->reports->latest();
}

}  // namespace graze
