#include "bench/graze_contender.hpp"

#include <algorithm>

namespace graze::bench {
namespace {

SceneSettings settings_of(const World& world, Task task, unsigned threads) {
  SceneSettings settings;
  settings.contact_distance = settings.range = world.distance;
  settings.detail = task == Task::A   ? ContactDetail::vertices
                    : task == Task::B ? ContactDetail::features
                                      : ContactDetail::none;
  settings.threads = threads;
  return settings;
}

FeaturePair::Feature feature_of(const Feature& feature) {
  return {static_cast<std::uint32_t>(feature.kind), feature.index};
}

}  // namespace

GrazeContender::GrazeContender(const BenchScene& scene, const World& world, Task task, unsigned threads,
                               Telling telling, InstructionSet set, Recorded recorded)
    : world_(world), task_(task), telling_(telling), set_(set), scene_(settings_of(world, task, threads)) {
  if (recorded == Recorded::in_memory) recorder_.emplace(scene_, RingSettings());
  const BindPolicy policy = telling == Telling::motion ? BindPolicy::when_told : BindPolicy::every_step;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    ObjectSettings settings;
    if (body.is_fixed) settings.motion = Motion::fixed;
    ids_.push_back(scene_.add(body.mesh, settings));
    if (!body.is_fixed)
      scene_.bind_positions(ids_[i], PositionView(world.positions_of(i), body.mesh->vertex_count()), policy);
  }
}

void GrazeContender::frame() {
  use_instruction_set(set_);  // no other scene steps meanwhile
  if (telling_ == Telling::motion) {
    moved_.clear();
    displacements_.clear();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (world_.displacements[i] == 0 || world_.objects[i].is_fixed) continue;
      moved_.push_back(ids_[i]);
      displacements_.push_back(world_.displacements[i]);
    }
    if (!moved_.empty()) scene_.positions_changed(moved_, displacements_);
  }
  report_ = scene_.step();
}

std::uint32_t GrazeContender::number_of(ObjectId id) const {
  return static_cast<std::uint32_t>(std::find(ids_.begin(), ids_.end(), id) - ids_.begin());
}

void GrazeContender::collect_contacts(const PairReport& pair, Found& found) const {
  const std::uint32_t a = number_of(pair.a);
  const std::uint32_t b = number_of(pair.b);
  if (task_ == Task::D) found.distances.push_back({a, b, pair.distance.lower, pair.distance.upper});
  for (const Contact& contact : report_->contacts(pair))
    if (task_ == Task::A)
      found.vertex_pairs.push_back({a, b, contact.feature_a.index, contact.feature_b.index});
    else
      found.feature_pairs.push_back(
          {a, b, feature_of(contact.feature_a), feature_of(contact.feature_b), contact.distance});
}

void GrazeContender::collect(Found& found) const {
  for (const PairReport& pair : report_->pairs())
    if (pair.phase != PairPhase::ended) collect_contacts(pair, found);
}

}  // namespace graze::bench
