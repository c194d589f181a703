#include "stress/soak/soak_world.hpp"

#include <algorithm>
#include <graze/enumerators.hpp>
#include <limits>

#include "models/models.hpp"
#include "scenes/mesh_of.hpp"
#include "stress/soak/timeless_rows.hpp"

namespace graze::tools {
namespace {

constexpr std::size_t least_bodies = 4;  // of each owner
constexpr std::size_t most_bodies = 14;
constexpr std::uint32_t kind_count = 3;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Mode {
  const char* name;
  ContactDetail detail;
  double tolerance;  ///< of Accuracy::within, 0 for exact
};
constexpr std::array<Mode, 8> modes = {{{"features", ContactDetail::features, 0},
                                        {"closest", ContactDetail::closest, 0},
                                        {"none", ContactDetail::none, 0},
                                        {"features within 0.05", ContactDetail::features, 0.05},
                                        {"regions", ContactDetail::regions, 0},
                                        {"vertices", ContactDetail::vertices, 0},
                                        {"nearest", ContactDetail::nearest, 0},
                                        {"none within 0.05", ContactDetail::none, 0.05}}};
static_assert(std::ranges::all_of(enumerators<ContactDetail>,
                                  [](ContactDetail detail) {
                                    return std::ranges::count(modes, detail, &Mode::detail) > 0;
                                  }),
              "each detail has a mode");

}  // namespace

SoakWorld::SoakWorld(std::uint64_t seed)
    : meshes_{scenes::mesh_of(models::sphere(9, 6, models::Faces::quads)),
              scenes::mesh_of(models::torus(12, 8, 0.5, 0.2)), scenes::mesh_of(models::box({0.7, 0.5, 0.9})),
              scenes::mesh_of(models::sheet(6, 6, 1.5, 1.5)), scenes::mesh_of(models::sphere(16, 9))},
      owners_{Owner(3 * seed), Owner(3 * seed + 1), Owner(3 * seed + 2)} {
  remake_scene();
  for (std::size_t i = 0; i < owners_.size(); ++i)
    while (owners_[i].bodies.size() < 2 * least_bodies)
      add(owners_[i], i == writer_count ? Given::bound : (i == 0 ? Given::copied : Given::posed));
}

void SoakWorld::remake_scene() {
  const Mode& mode = modes[mode_ % modes.size()];
  settings_.contact_distance = 0.03;
  settings_.range = 0.2;
  settings_.detail = mode.detail;
  settings_.accuracy = mode.tolerance > 0 ? Accuracy::within(mode.tolerance) : Accuracy::exact();
  settings_.threads = mode_ % 3 == 2 ? 1 : 2;
  ++mode_;
  scene_ = std::make_unique<Scene>(settings_);
  for (Owner& owner : owners_) owner.gone = {};  // the new scene may give that id to another object
  for (const auto& [kinds, rule] : rules_) scene_->set_rule(kinds.first, kinds.second, rule);
  std::map<std::uint64_t, ObjectId> ids;
  for (Body* const body : all_bodies()) {
    add_to_scene(*body);
    ids[body->serial] = body->id;
  }
  for (const auto& [a, b] : ignored_)
    if (ids.contains(a) && ids.contains(b)) scene_->ignore(ids[a], ids[b]);
}

std::string SoakWorld::mode() const {
  return modes[(mode_ - 1) % modes.size()].name;
}

std::vector<SoakWorld::Body*> SoakWorld::all_bodies() const {
  std::vector<Body*> bodies;
  for (const Owner& owner : owners_)
    for (const auto& body : owner.bodies) bodies.push_back(body.get());
  std::sort(bodies.begin(), bodies.end(), [](const Body* a, const Body* b) { return a->serial < b->serial; });
  return bodies;
}

void SoakWorld::add_to_scene(Body& body) {
  body.id = scene_->add(body.mesh, body.settings);
  body.is_new = true;
  if (body.given == Given::bound)
    scene_->bind_positions(body.id, body.positions, body.policy);
  else
    place(body);
}

void SoakWorld::add(Owner& owner, Given given) {
  scenes::Random& random = owner.random;
  auto body = std::make_unique<Body>();
  body->given = given;
  body->mesh = meshes_[random.below(meshes_.size())];
  body->settings.motion = given == Given::posed ? Motion::rigid : Motion::deformable;
  body->settings.kind = static_cast<std::uint32_t>(random.below(kind_count));
  body->settings.margin = random.chance(0.3) ? random.between(0, 0.03) : 0;
  if (random.chance(0.5)) body->policy = BindPolicy::when_told;
  teleport(random, *body);
  {
    const std::lock_guard lock(adding_);
    body->serial = next_serial_++;
    add_to_scene(*body);
  }
  owner.bodies.push_back(std::move(body));
}

void SoakWorld::remove_any(Owner& owner) {
  const auto gone =
      owner.bodies.begin() + static_cast<std::ptrdiff_t>(owner.random.below(owner.bodies.size()));
  owner.gone = (*gone)->id;
  scene_->remove(owner.gone);
  owner.bodies.erase(gone);
}

SoakWorld::Body& SoakWorld::any(Owner& owner) {
  return *owner.bodies[owner.random.below(owner.bodies.size())];
}

void SoakWorld::come_and_go(Owner& owner, bool is_bound) {
  if (owner.random.chance(0.1) && owner.bodies.size() < most_bodies)
    add(owner, is_bound ? Given::bound : (owner.random.chance(0.5) ? Given::copied : Given::posed));
  if (owner.random.chance(0.1) && owner.bodies.size() > least_bodies) remove_any(owner);
}

/// Somewhere in the room, now and then far from it. It has its own size, is a point, or is inside out.
void SoakWorld::teleport(scenes::Random& random, Body& body) {
  body.pose.linear() = random.turn();
  const double far = random.chance(0.05) ? 1e4 : 1.6;
  body.pose.translation() = random.vector(-far, far);
  const double size = random.chance(0.05) ? (random.chance(0.5) ? 0 : -1) : random.between(0.8, 1.2);
  body.positions.clear();
  for (const Eigen::Vector3d& rest : body.mesh->rest())
    body.positions.emplace_back(body.pose * (size * rest));
}

void SoakWorld::place(Body& body) {
  if (body.given == Given::posed)
    scene_->set_pose(body.id, body.pose);
  else
    scene_->set_positions(body.id, body.positions);
}

/// Every one is refused with a diagnostic. A bad pose is followed by the good one, so that the model does not
/// change.
void SoakWorld::make_mistake(Owner& owner) {
  Body& body = any(owner);
  std::vector<Eigen::Vector3d> positions = body.positions;
  Eigen::Isometry3d pose = body.pose;
  switch (owner.random.below(7)) {
    case 0:
      positions[owner.random.below(positions.size())].y() = not_a_number;
      return scene_->set_positions(body.id, positions);
    case 1:
      positions.pop_back();
      return scene_->set_positions(body.id, positions);
    case 2:
      return scene_->set_positions(body.id, PositionView());
    case 3:
      pose.linear() *= 1.01;
      scene_->set_pose(body.id, pose);
      if (body.given == Given::posed) place(body);
      return;
    case 4:
      return scene_->set_pose(owner.gone, pose);
    case 5:
      return scene_->ignore(body.id, body.id);
    default:
      return scene_->set_rule(1000, 0, {});
  }
}

void SoakWorld::write(std::size_t writer) {
  Owner& owner = owners_[writer];
  come_and_go(owner, false);
  if (owner.random.chance(0.3)) make_mistake(owner);
  for (const auto& body : owner.bodies) {
    const double chance = owner.random.between(0, 1);
    if (chance < 0.02) {
      teleport(owner.random, *body);
    } else if (chance < 0.7) {
      const Eigen::Vector3d way = owner.random.vector(-0.02, 0.02);
      body->pose.translation() += way;
      for (Eigen::Vector3d& position : body->positions) position += way;
    } else {
      continue;
    }
    place(*body);
  }
}

void SoakWorld::move_bound(Body& body, bool with_mistakes) {
  scenes::Random& random = owners_.back().random;
  double promise = Scene::any_displacement;
  if (body.is_spoiled || random.chance(0.03)) {
    const std::vector<Eigen::Vector3d> before = std::move(body.positions);  // still bound
    teleport(random, body);
    scene_->bind_positions(body.id, body.positions, body.policy);
    body.is_spoiled = false;
  } else {
    const Eigen::Vector3d way = random.vector(-0.02, 0.02);
    for (Eigen::Vector3d& position : body.positions) position += way;
    if (!body.is_new && random.chance(0.5)) promise = way.norm() + 1e-9;
  }
  body.is_new = false;
  if (random.chance(0.02)) {  // copied for a while, then bound with another policy
    scene_->unbind_positions(body.id);
    scene_->set_positions(body.id, body.positions);
    body.policy = random.chance(0.5) ? BindPolicy::every_step : BindPolicy::when_told;
    scene_->bind_positions(body.id, body.positions, body.policy);
  }
  if (with_mistakes && random.chance(0.01)) {
    body.positions[random.below(body.positions.size())].x() = not_a_number;
    body.is_spoiled = true;
  }
  if (body.policy == BindPolicy::when_told || promise != Scene::any_displacement || body.is_spoiled)
    scene_->positions_changed(body.id, body.is_spoiled ? Scene::any_displacement : promise);
}

void SoakWorld::change_pairs() {
  const auto bodies = all_bodies();
  scenes::Random& random = owners_.back().random;
  const Body& a = *bodies[random.below(bodies.size())];
  const Body& b = *bodies[random.below(bodies.size())];
  if (a.serial == b.serial) return;
  const std::pair<std::uint64_t, std::uint64_t> pair = std::minmax(a.serial, b.serial);
  if (random.chance(0.5)) {
    scene_->ignore(a.id, b.id);
    if (std::find(ignored_.begin(), ignored_.end(), pair) == ignored_.end()) ignored_.push_back(pair);
  } else {
    scene_->watch(b.id, a.id);
    std::erase(ignored_, pair);
  }
  // Ignored pairs of objects that are gone are forgotten.
  std::erase_if(ignored_, [&](const auto& old) {
    const auto lives = [&](std::uint64_t serial) {
      return std::any_of(bodies.begin(), bodies.end(),
                         [&](const Body* body) { return body->serial == serial; });
    };
    return !lives(old.first) || !lives(old.second);
  });
}

void SoakWorld::change_rules() {
  scenes::Random& random = owners_.back().random;
  const auto a = static_cast<std::uint32_t>(random.below(kind_count));
  const auto b = static_cast<std::uint32_t>(random.below(kind_count));
  const double threshold = random.between(0, 0.06);
  const PairRule rule{threshold, random.between(0, 0.3), {}};
  rules_[std::minmax(a, b)] = rule;
  scene_->set_rule(a, b, rule);
}

void SoakWorld::change_between_steps(bool with_mistakes) {
  Owner& owner = owners_.back();
  come_and_go(owner, true);
  if (with_mistakes && owner.random.chance(0.3)) make_mistake(owner);
  for (const auto& body : owner.bodies) move_bound(*body, with_mistakes);
  if (owner.random.chance(0.1)) change_pairs();
  if (owner.random.chance(0.02)) change_rules();
}

ReportHandle SoakWorld::built_afresh(std::map<ObjectId, std::size_t>& places) const {
  Scene scene(settings_);
  for (const auto& [kinds, rule] : rules_) scene.set_rule(kinds.first, kinds.second, rule);
  std::map<std::uint64_t, ObjectId> ids;
  for (const Body* const body : all_bodies()) {
    const ObjectId id = scene.add(body->mesh, body->settings);
    places[id] = ids.size();
    ids[body->serial] = id;
    if (body->given == Given::posed)
      scene.set_pose(id, body->pose);
    else
      scene.set_positions(id, body->positions);
  }
  for (const auto& [a, b] : ignored_)
    if (ids.contains(a) && ids.contains(b)) scene.ignore(ids[a], ids[b]);
  return scene.step();
}

std::string SoakWorld::difference_from_fresh(const FrameReport& report) const {
  std::map<ObjectId, std::size_t> fresh_places;
  const ReportHandle fresh = built_afresh(fresh_places);
  std::map<ObjectId, std::size_t> places;
  for (const Body* const body : all_bodies()) {
    const std::size_t place = places.size();
    places[body->id] = place;
  }
  const bool is_exact = settings_.accuracy.mode() == AccuracyMode::exact;
  return difference_of(timeless_rows(report, places, is_exact),
                       timeless_rows(*fresh, fresh_places, is_exact));
}

}  // namespace graze::tools
