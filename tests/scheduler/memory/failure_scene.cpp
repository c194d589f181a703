#include "scheduler/memory/failure_scene.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>

namespace graze::tests {
namespace {

using Given = FailureScene::Given;

bool is_contact(const PairReport& pair) {
  return pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
}

std::vector<std::shared_ptr<const Mesh>> meshes_of(FailureStory story) {
  if (story == FailureStory::large) {
    const auto sheet = mesh_of(models::sheet(64, 64, 2, 2));
    return {sheet, sheet, mesh_of(models::box({0.5, 0.4, 0.6}))};
  }
  const auto sphere = mesh_of(models::sphere(5, 2));
  return {sphere,
          mesh_of(models::box({0.9, 0.6, 0.8})),
          mesh_of(models::torus(5, 4, 0.6, 0.25)),
          sphere,
          mesh_of(models::sheet(3, 3, 1.4, 1.2)),
          mesh_of(models::box({0.7, 0.7, 0.7}, models::Faces::triangles))};
}

Given given_in(FailureStory story, std::size_t body) {
  switch (story) {
    case FailureStory::copied:
      return Given::copied;
    case FailureStory::bound:
      return Given::bound;
    case FailureStory::told:
      return Given::told;
    case FailureStory::posed:
      return body == 0 ? Given::fixed : Given::posed;
    case FailureStory::replaced:
      return body % 2 == 0 ? Given::copied : Given::posed;
    case FailureStory::large:
      return body == 0 ? Given::copied : Given::bound;
    default:
      return static_cast<Given>(body % 4);
  }
}

/// The same mesh without its first face.
std::shared_ptr<const Mesh> without_a_face(const Mesh& mesh) {
  std::vector<std::uint32_t> corners, counts;
  for (std::uint32_t face = 1; face < mesh.face_count(); ++face) {
    corners.insert(corners.end(), mesh.face(face).begin(), mesh.face(face).end());
    counts.push_back(static_cast<std::uint32_t>(mesh.face(face).size()));
  }
  return std::make_shared<const Mesh>(Mesh::from_polygons(mesh.rest(), corners, counts));
}

}  // namespace

FailureScene::FailureScene(FailureStory story, std::size_t event) : story_(story), event_(event) {
  const double spread = story == FailureStory::large ? 0.1 : 0.8;
  for (const auto& mesh : meshes_of(story)) add_body(mesh, given_in(story, bodies_.size()), spread);
}

void FailureScene::add_body(const std::shared_ptr<const Mesh>& mesh, Given given, double spread) {
  const auto number = static_cast<double>(bodies_.size());
  Body body;
  body.mesh = mesh;
  if (story_ == FailureStory::replaced) body.next_mesh = without_a_face(*mesh);
  for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex)
    body.same_vertices.push_back(vertex);
  body.given = given;
  body.is_float = bodies_.size() % 2 == 1;
  const Eigen::Vector3d centre(spread * std::sin(2.1 * number), spread * std::cos(1.3 * number),
                               0.5 * spread * std::sin(4.7 * number));
  const Eigen::Vector3d way(std::sin(number), std::cos(3 * number), std::sin(5 * number));
  const Eigen::Vector3d axis = Eigen::Vector3d(1, number - 3, 0.5).normalized();
  for (std::size_t frame = 0; frame < frame_count; ++frame) {
    const auto time = static_cast<double>(frame);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (given != Given::fixed) {
      pose.linear() = Eigen::AngleAxisd(0.2 * number + 0.11 * time, axis).toRotationMatrix();
      pose.translation() = centre + 0.25 * spread * std::sin(1.1 * time + number) * way;
    }
    Positions positions;
    std::vector<Eigen::Vector3f> floats;
    for (const Eigen::Vector3d& rest : mesh->rest()) {
      const Eigen::Vector3d bent = rest + 0.05 * std::sin(time) * Eigen::Vector3d(0, 0, rest.x() * rest.y());
      floats.emplace_back((pose * bent).cast<float>());
      positions.emplace_back(body.is_float ? floats.back().cast<double>() : pose * bent);
    }
    double promise = 0;
    if (frame > 0)
      for (std::size_t i = 0; i < positions.size(); ++i)
        promise = std::max(promise, (positions[i] - body.positions.back()[i]).norm());
    body.poses.push_back(pose);
    body.positions.push_back(std::move(positions));
    body.floats.push_back(std::move(floats));
    body.promises.push_back(promise);
  }
  bodies_.push_back(std::move(body));
}

SceneSettings FailureScene::settings(ContactDetail detail, unsigned threads) const {
  using namespace std::chrono_literals;
  SceneSettings settings = settings_of(0.1, 0.4, detail);
  settings.threads = threads;
  if (story_ == FailureStory::large) {
    settings.contact_distance = 0.01;
    settings.range = 0.1;
    settings.region_distances = 40;
  }
  if (story_ == FailureStory::budgets) {
    if (threads == 1)
      settings.work_budget = std::uint64_t{1} << 40;
    else
      settings.time_budget = 1h;
  }
  return settings;
}

bool FailureScene::is_there(std::size_t body, std::size_t frame) const {
  if (story_ != FailureStory::come_and_go) return true;
  const bool goes = body == 1;
  const bool comes = body + 1 == bodies_.size();
  return goes ? frame < event_ : !comes || frame >= event_;
}

Given FailureScene::given(std::size_t body, std::size_t frame) const {
  const bool ends_binding = story_ == FailureStory::bound && (body == 0 || body == 2);
  return ends_binding && frame >= event_ ? Given::copied : bodies_[body].given;
}

// ---- A scene that plays it

FailurePlay::FailurePlay(const FailureScene& story, const SceneSettings& settings)
    : story_(story), scene_(std::make_unique<Scene>(settings)), told_(story.bodies().size()) {
  for (std::size_t body = 0; body < told_.size(); ++body) {
    const FailureScene::Body& told = story.bodies()[body];
    if (told.given == Given::bound || told.given == Given::told) {
      if (told.is_float)
        told_[body].floats = std::make_unique<std::vector<Eigen::Vector3f>>(told.floats[0]);
      else
        told_[body].doubles = std::make_unique<Positions>(told.positions[0]);
      if (story.story() == FailureStory::bound)
        told_[body].next_doubles = std::make_unique<Positions>(told.positions[story.event()]);
    }
    if (story.is_there(body, 0) && !(story.event() == 0 && body + 1 == told_.size())) add(body);
  }
  batch_.reserve(told_.size());
  batch_poses_.reserve(told_.size());
}

void FailurePlay::add(std::size_t body) {
  const FailureScene::Body& told = story_.bodies()[body];
  ObjectSettings settings = motion_of(told.given == Given::posed   ? Motion::rigid
                                      : told.given == Given::fixed ? Motion::fixed
                                                                   : Motion::deformable);
  settings.name = "a body whose name is longer than what a string holds by itself";
  settings.kind = body < 3 ? FailureScene::ruled_kind : 0;
  told_[body].id = scene_->add(told.mesh, settings);
  if (told.given == Given::bound) scene_->bind_positions(*told_[body].id, memory(body));
  if (told.given == Given::told) scene_->bind_positions(*told_[body].id, memory(body), BindPolicy::when_told);
}

void FailurePlay::replace(std::size_t body) {
  const FailureScene::Body& told = story_.bodies()[body];
  scene_->replace_mesh(*told_[body].id, told.next_mesh, told.same_vertices);
  told_[body].is_replaced = true;
}

PositionView FailurePlay::memory(std::size_t body) const {
  return told_[body].floats ? PositionView(*told_[body].floats) : PositionView(*told_[body].doubles);
}

/// Into what is bound.
void FailurePlay::write(std::size_t body, std::size_t frame) {
  const FailureScene::Body& told = story_.bodies()[body];
  if (told_[body].floats)
    std::copy(told.floats[frame].begin(), told.floats[frame].end(), told_[body].floats->begin());
  if (told_[body].doubles)
    std::copy(told.positions[frame].begin(), told.positions[frame].end(), told_[body].doubles->begin());
}

void FailurePlay::place(std::size_t body, std::size_t frame) {
  const FailureScene::Body& told = story_.bodies()[body];
  const ObjectId id = *told_[body].id;
  const bool promises = body % 3 != 2;
  const double promise = promises && frame > 0 ? told.promises[frame] : Scene::any_displacement;
  switch (story_.given(body, frame)) {
    case Given::copied:
      if (told.is_float) return scene_->set_positions(id, told.floats[frame], promise);
      return scene_->set_positions(id, told.positions[frame], promise);
    case Given::bound:
      write(body, frame);
      if (body % 4 == 3) scene_->positions_changed(id, promise);
      return;
    case Given::told:
      write(body, frame);
      return scene_->positions_changed(id, promise);
    case Given::posed:
      if (body % 2 == 1) return scene_->set_pose(id, told.poses[frame]);
      batch_.push_back(id);
      batch_poses_.push_back(told.poses[frame]);
      return;
    case Given::fixed:
      return;
  }
}

void FailurePlay::tell(std::size_t frame) {
  if (frame == story_.event()) tell_event();
  tell_filters(frame);
  batch_.clear();
  batch_poses_.clear();
  for (std::size_t body = 0; body < told_.size(); ++body)
    if (told_[body].id && story_.is_there(body, frame)) place(body, frame);
  if (!batch_.empty()) scene_->set_poses(batch_, batch_poses_);
  if (story_.story() == FailureStory::reserved && frame == story_.event())
    scene_->reserve({.objects = 10, .calls_per_step = 100, .near_pairs = 10, .contacts = 100, .reports = 3});
  // Last, since it may throw. It is made up for in the next frame.
  for (std::size_t body = 0; body < told_.size(); ++body)
    if (!told_[body].id && story_.is_there(body, frame)) {
      add(body);
      place(body, frame);
      if (!batch_.empty()) scene_->set_poses(batch_, batch_poses_);
    }
  for (std::size_t body = 0; body < told_.size(); ++body)
    if (told_[body].id && !told_[body].is_replaced &&
        story_.mesh(body, frame) != story_.bodies()[body].mesh) {
      replace(body);
      place(body, frame);
    }
}

void FailurePlay::tell_event() {
  const auto free_memory = [&](std::size_t body) {
    told_[body].doubles.reset();
    told_[body].floats.reset();
  };
  if (story_.story() == FailureStory::come_and_go && told_[1].id) {
    scene_->remove(*told_[1].id);
    free_memory(1);
  }
  if (story_.story() == FailureStory::bound && told_[0].next_doubles) {
    write(0, story_.event());
    scene_->unbind_positions(*told_[0].id);
    free_memory(0);
    scene_->set_positions(*told_[2].id, story_.bodies()[2].positions[story_.event()]);
    free_memory(2);
    scene_->bind_positions(*told_[1].id, *told_[1].next_doubles);
    free_memory(1);
    told_[1].doubles = std::move(told_[1].next_doubles);
    told_[0].next_doubles.reset();
  }
}

void FailurePlay::tell_filters(std::size_t frame) {
  if (!story_.has_filters(frame)) return;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  scene_->ignore(*told_[0].id, *told_[2].id);
  scene_->ignore(*told_[3].id, *told_[4].id);
  scene_->watch(*told_[3].id, *told_[4].id);
  scene_->set_rule(FailureScene::ruled_kind, FailureScene::ruled_kind, FailureScene::rule());
  // All of these are refused.
  scene_->ignore(*told_[0].id, *told_[0].id);
  scene_->set_rule(1000, 0, {});
  scene_->set_pose({1000, 1}, Eigen::Isometry3d::Identity());
  scene_->set_pose(*told_[0].id, Eigen::Isometry3d::Identity());
  scene_->set_positions(*told_[4].id, PositionView());
  scene_->positions_changed(*told_[1].id, nothing);
  scene_->unbind_positions({1000, 1});
  scene_->remove({1000, 1});
  scene_->set_poses(std::span(&*told_[3].id, 1), {});
}

ReportHandle FailurePlay::step(std::size_t frame) {
  if (story_.story() == FailureStory::async) {
    scene_->step_async();
    // Taken up by the step after this one, which is told the same once more.
    if (frame + 1 < FailureScene::frame_count)
      for (std::size_t body = 0; body < told_.size(); ++body)
        if (story_.given(body, frame) == Given::copied)
          scene_->set_positions(*told_[body].id, story_.bodies()[body].positions[frame + 1]);
    return scene_->wait();
  }
  ReportHandle report = scene_->step();
  if (story_.story() == FailureStory::reserved) held_[frame % held_.size()] = report;
  return report;
}

std::optional<std::size_t> FailurePlay::body_of(ObjectId id) const {
  for (std::size_t body = 0; body < told_.size(); ++body)
    if (told_[body].id == id) return body;
  return std::nullopt;
}

// ---- What a scene built afresh says

FreshReport::Row FreshReport::row_of(const FrameReport& report, const PairReport& pair, std::size_t a,
                                     std::size_t b) {
  Row row{a, b, is_contact(pair), {pair.distance.lower, pair.distance.upper}};
  const auto add_point = [&](const Eigen::Vector3d& point) {
    row.numbers.insert(row.numbers.end(), {point.x(), point.y(), point.z()});
  };
  const auto add_features = [&](const Feature& of_a, const Feature& of_b) {
    row.numbers.insert(row.numbers.end(),
                       {double(of_a.kind), double(of_a.index), double(of_b.kind), double(of_b.index)});
  };
  add_features(pair.witness.feature_a, pair.witness.feature_b);
  add_point(pair.witness.point_a);
  add_point(pair.witness.point_b);
  for (const Contact& contact : report.contacts(pair)) {
    add_features(contact.feature_a, contact.feature_b);
    row.numbers.insert(row.numbers.end(), {double(contact.kind), double(contact.side_a),
                                           double(contact.side_b), contact.distance});
    add_point(contact.point_a);
    add_point(contact.point_b);
    add_point(contact.normal);
  }
  return row;
}

FreshReport::FreshReport(const FailureScene& story, SceneSettings settings, std::size_t frame) {
  settings.threads = 1;
  Scene scene(settings);
  std::vector<std::size_t> bodies;
  std::vector<ObjectId> ids(story.bodies().size());
  for (std::size_t body = 0; body < ids.size(); ++body) {
    if (!story.is_there(body, frame)) continue;
    const FailureScene::Body& told = story.bodies()[body];
    ObjectSettings object = motion_of(told.given == Given::posed   ? Motion::rigid
                                      : told.given == Given::fixed ? Motion::fixed
                                                                   : Motion::deformable);
    object.kind = body < 3 ? FailureScene::ruled_kind : 0;
    ids[body] = scene.add(story.mesh(body, frame), object);
    bodies.push_back(body);
    if (told.given == Given::posed || told.given == Given::fixed)
      scene.set_pose(ids[body], told.poses[frame]);
    else
      scene.set_positions(ids[body], told.positions[frame]);
  }
  if (story.has_filters(frame)) {
    scene.ignore(ids[0], ids[2]);
    scene.set_rule(FailureScene::ruled_kind, FailureScene::ruled_kind, FailureScene::rule());
  }
  const ReportHandle report = scene.step();
  for (const PairReport& pair : report->pairs())
    rows_.push_back(row_of(*report, pair, bodies[pair.a.index], bodies[pair.b.index]));
}

std::string FreshReport::difference_from(const FailurePlay& play, const FrameReport& report,
                                         const FrameReport& before) const {
  auto expected = rows_.begin();
  const auto name = [](std::size_t a, std::size_t b) {
    return "pair " + std::to_string(a) + ", " + std::to_string(b);
  };
  for (const PairReport& pair : report.pairs()) {
    const auto a = play.body_of(pair.a);
    const auto b = play.body_of(pair.b);
    if (!a || !b) return "a pair of an object that is not there";
    const Row row = row_of(report, pair, *a, *b);
    const PairReport* const last = find_pair(before, pair.a, pair.b);
    const bool was = last != nullptr && is_contact(*last);
    const PairPhase phase = row.in_contact ? (was ? PairPhase::touching : PairPhase::began)
                                           : (was ? PairPhase::ended : PairPhase::near);
    if (pair.phase != phase) return name(*a, *b) + " is not in the phase that follows from the report before";
    if (pair.stale || !pair.complete) return name(*a, *b) + " is stale or incomplete";
    const bool is_expected = expected != rows_.end() && expected->a == *a && expected->b == *b;
    if (!is_expected && phase == PairPhase::ended) continue;  // out of range, or filtered out
    if (!is_expected) return name(*a, *b) + " is not what a scene built afresh lists there";
    const auto has_same_bits = [](double l, double r) {
      return std::bit_cast<std::uint64_t>(l) == std::bit_cast<std::uint64_t>(r);
    };
    if (row.in_contact != expected->in_contact ||
        !std::equal(row.numbers.begin(), row.numbers.end(), expected->numbers.begin(),
                    expected->numbers.end(), has_same_bits))
      return name(*a, *b) + " is otherwise in a scene built afresh";
    ++expected;
  }
  if (expected != rows_.end()) return name(expected->a, expected->b) + " is missing";
  for (const PairReport& last : before.pairs())
    if (is_contact(last) && find_pair(report, last.a, last.b) == nullptr && play.scene_contains(last.a) &&
        play.scene_contains(last.b))
      return "a contact has ended without being listed";
  return {};
}

}  // namespace graze::tests
