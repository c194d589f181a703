#include <atomic>
#include <graze/error.hpp>
#include <graze/floating_point_scope.hpp>
#include <graze/scene.hpp>
#include <utility>

#include "report_pool.hpp"
#include "settings_check.hpp"
#include "staging.hpp"
#include "step.hpp"

namespace graze {
namespace {

const SceneSettings& checked(const SceneSettings& settings) {
  if (const auto problem = problem_of(settings)) throw Error(*problem);
  return settings;
}

/// Says that a step runs, for as long as it does; throws where one already ran.
class StepGuard {
 public:
  explicit StepGuard(std::atomic<bool>& stepping) : stepping_(stepping) {
    if (stepping_.exchange(true, std::memory_order_acquire))
      throw Error("scene: a step of this scene is already running on another thread");
  }
  ~StepGuard() { stepping_.store(false, std::memory_order_release); }
  StepGuard(const StepGuard&) = delete;
  StepGuard& operator=(const StepGuard&) = delete;

 private:
  std::atomic<bool>& stepping_;
};

}  // namespace

class Scene::State {
 public:
  explicit State(const SceneSettings& given)
      : settings(checked(given)), step(settings, staging), reports(ReportPool::create()) {}
  ~State() { reports->close(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  const SceneSettings settings;
  Staging staging;
  Step step;
  ReportPool* const reports;  ///< deletes itself when the scene and all handles are gone
  std::atomic<bool> stepping{false};
  std::uint64_t frame = 0;
};

Scene::Scene(const SceneSettings& settings) : state_(std::make_unique<State>(settings)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const SceneSettings& Scene::settings() const {
  return state_->settings;
}

ObjectId Scene::add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
  return state_->staging.add(std::move(mesh), settings);
}
void Scene::remove(ObjectId object) {
  state_->staging.remove(object);
}
std::size_t Scene::object_count() const {
  return state_->staging.object_count();
}
bool Scene::contains(ObjectId object) const {
  return state_->staging.find(object).mesh != nullptr;
}
std::shared_ptr<const Mesh> Scene::mesh(ObjectId object) const {
  return state_->staging.find(object).mesh;
}
ObjectSettings Scene::object_settings(ObjectId object) const {
  return state_->staging.find(object).settings;
}

void Scene::set_pose_rows(ObjectId object, const std::array<double, 12>& rows) {
  state_->staging.set_pose(object, rows);
}
void Scene::set_positions(ObjectId object, PositionView positions, double max_displacement) {
  state_->staging.set_positions(object, positions, max_displacement);
}
void Scene::bind_positions(ObjectId object, PositionView positions, BindPolicy policy) {
  state_->staging.bind_positions(object, positions, policy);
}
void Scene::unbind_positions(ObjectId object) {
  state_->staging.unbind_positions(object);
}
void Scene::positions_changed(ObjectId object, double max_displacement) {
  state_->staging.positions_changed(object, max_displacement);
}
void Scene::ignore(ObjectId a, ObjectId b) {
  state_->staging.set_ignored(a, b, true);
}
void Scene::watch(ObjectId a, ObjectId b) {
  state_->staging.set_ignored(a, b, false);
}
void Scene::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  state_->staging.set_rule(kind_a, kind_b, rule);
}

ReportHandle Scene::step() {
  const StepGuard guard(state_->stepping);
  const FloatingPointScope scope;
  FrameReport& report = state_->reports->begin();
  const ReportHandle previous = state_->reports->latest();
  state_->step.run(++state_->frame, *previous, report);
  return state_->reports->publish();
}

ReportHandle Scene::latest_report() const {
  return state_->reports->latest();
}

}  // namespace graze
