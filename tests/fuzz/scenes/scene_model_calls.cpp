// The model's side of each call on a scene: the outcome that the call must have.

#include <algorithm>
#include <cmath>
#include <graze/error.hpp>
#include <limits>

#include "fuzz/finding.hpp"
#include "scene_model.hpp"

namespace graze::fuzz {
namespace {

bool is_within_limits(const Eigen::Vector3d& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= 0x1p120;
}

/// Returns the problem of the first used vertex that cannot be taken.
DiagnosticKind problem_of(const Mesh& mesh, const Positions& positions) {
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
    if (mesh.is_used(vertex) && !is_within_limits(positions[vertex]))
      return positions[vertex].allFinite() ? DiagnosticKind::too_large : DiagnosticKind::not_finite;
  finding("no problem with these positions");
}

/// Whether each edge has two faces that pass it in opposite directions.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> faces_of;  // by direction
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::span<const std::uint32_t> corner = mesh.face(face);
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const std::uint32_t next = corner[(i + 1) % corner.size()];
      if (corner[i] != next) faces_of[{corner[i], next}].push_back(face);
    }
  }
  return std::all_of(faces_of.begin(), faces_of.end(), [&](const auto& passed) {
    const auto& [ends, faces] = passed;
    const auto back = faces_of.find({ends.second, ends.first});
    return faces.size() == 1 && back != faces_of.end() && back->second.size() == 1 &&
           back->second[0] != faces[0];
  });
}

bool have_good_groups(const Mesh& mesh, const std::vector<std::uint8_t>& face_groups) {
  return face_groups.empty() || face_groups.size() == mesh.face_count();
}

bool is_map_into(const Mesh& mesh, const std::vector<std::uint32_t>& new_of_old) {
  return std::all_of(new_of_old.begin(), new_of_old.end(), [&](std::uint32_t vertex) {
    return vertex == Mesh::no_vertex || vertex < mesh.vertex_count();
  });
}

/// Whether memory that was just written has to be told of before the next step. Steps may read memory late
/// that was told of once. So the rules of bound memory forbid to change it silently.
bool must_tell(const ModelBody& body) {
  return body.is_promised || (body.policy == BindPolicy::when_told && body.was_told);
}

Positions posed(const Mesh& mesh, const PoseRows& m) {
  Positions positions;
  for (const Eigen::Vector3d& p : mesh.rest())
    positions.emplace_back(((m[0] * p.x() + m[1] * p.y()) + m[2] * p.z()) + m[3],
                           ((m[4] * p.x() + m[5] * p.y()) + m[6] * p.z()) + m[7],
                           ((m[8] * p.x() + m[9] * p.y()) + m[10] * p.z()) + m[11]);
  return positions;
}

}  // namespace

Positions ModelBody::memory() const {
  if (doubles) return *doubles;
  Positions positions;
  for (const Eigen::Vector3f& position : *floats) positions.emplace_back(position.cast<double>());
  return positions;
}

void ModelBody::write_memory(const Positions& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (doubles)
      (*doubles)[i] = positions[i];
    else
      (*floats)[i] = positions[i].cast<float>();
}

bool ModelBody::can_take(const Positions& positions) const {
  for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex)
    if (mesh->is_used(vertex) && !is_within_limits(positions[vertex])) return false;
  return true;
}

SceneModel::SceneModel(const SceneSettings& settings) : scene_(settings) {}

void SceneModel::add(std::shared_ptr<const Mesh> mesh, ObjectSettings settings) {
  settings.user_data = bodies_.size() + 1;
  const bool is_good = settings.margin >= 0 && std::isfinite(settings.margin) && settings.kind <= 255 &&
                       (!settings.solid || is_closed(*mesh)) &&
                       have_good_groups(*mesh, settings.face_groups) && settings.self_rings <= 8;
  ModelBody body;
  try {
    body.id = scene_.add(mesh, settings);
  } catch (const Error&) {
    return expect(!is_good, "good settings of an object are refused");
  }
  expect(is_good, "bad settings of an object are taken");
  expect(body_of_.emplace(body.id, bodies_.size()).second, "an id is given a second time");
  body.mesh = std::move(mesh);
  body.settings = settings;
  body.seen.assign(body.mesh->rest().begin(), body.mesh->rest().end());
  is_swept_added_ = is_swept_added_ || settings.swept;
  bodies_.push_back(std::move(body));
}

void SceneModel::remove(std::size_t index) {
  ModelBody& body = bodies_[index];
  scene_.remove(body.id);
  if (!body.is_alive) expect_diagnostic(body.id, DiagnosticKind::stale_id);
  body.is_alive = false;
  body.doubles.reset();
  body.floats.reset();
}

ModelBody* SceneModel::deformable(std::size_t index) {
  ModelBody& body = bodies_[index];
  if (body.is_alive && body.settings.motion == Motion::deformable) return &body;
  expect_diagnostic(body.id, body.is_alive ? DiagnosticKind::wrong_motion : DiagnosticKind::stale_id);
  return nullptr;
}

double SceneModel::promise_of(const ModelBody& body, const Positions& positions, Promise promise) {
  if (promise == Promise::none || promise == Promise::jump) return Scene::any_displacement;
  if (promise == Promise::senseless) {
    expect_diagnostic(body.id, DiagnosticKind::broken_promise);
    return std::numeric_limits<double>::quiet_NaN();
  }
  double most = 0;
  for (std::uint32_t vertex = 0; vertex < body.mesh->vertex_count(); ++vertex) {
    const Eigen::Vector3d way = positions[vertex] - body.seen[vertex];
    if (body.mesh->is_used(vertex)) most = std::max(most, std::hypot(way.x(), way.y(), way.z()));
  }
  return most * (1 + 0x1p-40);
}

void SceneModel::set_positions(std::size_t index, const Positions& positions, Promise promise) {
  ModelBody& body = bodies_[index];
  if (deformable(index) == nullptr) return scene_.set_positions(body.id, positions);
  const bool is_good = body.can_take(positions);
  const double most = is_good ? promise_of(body, positions, promise) : Scene::any_displacement;
  if (is_good && promise == Promise::jump) {
    scene_.set_positions(body.id, positions, teleport);
    body.jumps = true;
  } else {
    scene_.set_positions(body.id, positions, most);
  }
  if (!is_good) return expect_diagnostic(body.id, problem_of(*body.mesh, positions));
  body.copied = positions;
  body.is_bound = false;
}

void SceneModel::bind(std::size_t index, const Positions& positions, bool as_floats, BindPolicy policy) {
  ModelBody& body = bodies_[index];
  if (deformable(index) == nullptr) return scene_.bind_positions(body.id, positions, policy);
  auto doubles = as_floats ? nullptr : std::make_unique<Positions>(positions.size());
  auto floats = as_floats ? std::make_unique<std::vector<Eigen::Vector3f>>(positions.size()) : nullptr;
  scene_.bind_positions(body.id, as_floats ? PositionView(*floats) : PositionView(*doubles), policy);
  body.doubles = std::move(doubles);
  body.floats = std::move(floats);
  body.write_memory(positions);
  body.copied.reset();
  body.is_bound = true;
  body.policy = policy;
  body.is_told = true;
  body.was_told = body.is_promised = false;
}

void SceneModel::write(std::size_t index, const Positions& positions, bool tell, Promise promise) {
  ModelBody& body = bodies_[index];
  const bool has_memory = body.is_alive && body.is_bound;
  if (has_memory) body.write_memory(positions);
  if (!tell && !must_tell(body)) return;
  if (deformable(index) == nullptr) return scene_.positions_changed(body.id);
  const bool is_good = has_memory && body.can_take(body.memory());
  if (is_good && promise == Promise::jump) {
    scene_.positions_changed(body.id, teleport);
    body.jumps = true;
  } else {
    scene_.positions_changed(body.id,
                             is_good ? promise_of(body, body.memory(), promise) : Scene::any_displacement);
  }
  body.is_told = body.was_told = true;
  body.is_promised = is_good && promise == Promise::kept;
}

void SceneModel::unbind(std::size_t index) {
  ModelBody& body = bodies_[index];
  scene_.unbind_positions(body.id);
  if (deformable(index) == nullptr) return;
  if (body.is_bound && (body.policy == BindPolicy::every_step || body.is_told)) {
    const Positions last = body.memory();
    if (body.can_take(last))
      body.copied = last;
    else
      expect_diagnostic(body.id, problem_of(*body.mesh, last));
    if (!body.copied) body.is_frozen = true;
  }
  body.is_bound = false;
  body.doubles.reset();
  body.floats.reset();
}

void SceneModel::set_pose(std::size_t index, const PoseRows& rows, bool is_rotation, bool jumps) {
  ModelBody& body = bodies_[index];
  if (jumps) {
    scene_.set_pose_rows(body.id, rows, teleport);
    body.jumps = true;
  } else {
    scene_.set_pose_rows(body.id, rows);
  }
  if (!body.is_alive)
    expect_diagnostic(body.id, DiagnosticKind::stale_id);
  else if (body.settings.motion == Motion::deformable)
    expect_diagnostic(body.id, DiagnosticKind::wrong_motion);
  else if (is_rotation)
    body.staged_pose = rows;
  else {
    expect_diagnostic(body.id, DiagnosticKind::bad_pose);
    body.staged_pose.reset();
    body.is_frozen = true;
  }
}

void SceneModel::set_ignored(std::size_t a, std::size_t b, bool ignored) {
  const ObjectId id_a = bodies_[a].id;
  const ObjectId id_b = bodies_[b].id;
  if (ignored)
    scene_.ignore(id_a, id_b);
  else
    scene_.watch(id_a, id_b);
  for (const std::size_t body : {a, b})
    if (!bodies_[body].is_alive) return expect_diagnostic(bodies_[body].id, DiagnosticKind::stale_id);
  if (a == b) return expect_diagnostic(id_a, DiagnosticKind::bad_pair);
  if (ignored)
    ignored_.insert(std::minmax(a, b));
  else
    ignored_.erase(std::minmax(a, b));
}

void SceneModel::set_ignored_groups(const BodyGroup& a, const BodyGroup& b, bool ignored) {
  const ObjectId id_a = bodies_[a.body].id;
  const ObjectId id_b = bodies_[b.body].id;
  if (ignored)
    scene_.ignore(id_a, a.group, id_b, b.group);
  else
    scene_.watch(id_a, a.group, id_b, b.group);
  for (const std::size_t body : {a.body, b.body})
    if (!bodies_[body].is_alive) return expect_diagnostic(bodies_[body].id, DiagnosticKind::stale_id);
  if (ignored)
    ignored_groups_.insert(std::minmax(a, b));
  else
    ignored_groups_.erase(std::minmax(a, b));
}

/// The object forgets what it was to read from the old mesh, but keeps its pose. A stale id has no mesh that
/// the map could not fit.
void SceneModel::replace_mesh(std::size_t index, const std::shared_ptr<const Mesh>& mesh,
                              const std::vector<std::uint32_t>& new_of_old,
                              const std::vector<std::uint8_t>& face_groups) {
  ModelBody& body = bodies_[index];
  const bool fits =
      new_of_old.size() == body.mesh->vertex_count() && (!body.settings.solid || is_closed(*mesh));
  const bool is_good =
      is_map_into(*mesh, new_of_old) && have_good_groups(*mesh, face_groups) && (fits || !body.is_alive);
  try {
    scene_.replace_mesh(body.id, mesh, new_of_old, face_groups);
  } catch (const Error&) {
    return expect(!is_good, "a good mesh is refused");
  }
  expect(is_good, "a bad mesh is taken");
  if (!body.is_alive) return expect_diagnostic(body.id, DiagnosticKind::stale_id);
  body.mesh = mesh;
  body.settings.face_groups = face_groups;
  body.seen.assign(mesh->rest().begin(), mesh->rest().end());
  body.is_unseen = true;
  if (body.settings.motion != Motion::deformable) return;
  body.copied.reset();
  body.doubles.reset();
  body.floats.reset();
  body.is_bound = body.is_told = body.is_promised = body.is_frozen = false;
}

void SceneModel::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  scene_.set_rule(kind_a, kind_b, rule);
  if (kind_a > 255 || kind_b > 255 || !(rule.contact_distance.value_or(0) >= 0) ||
      std::isinf(rule.contact_distance.value_or(0)) || !(rule.range.value_or(0) >= 0))
    return expect_diagnostic({}, DiagnosticKind::bad_rule);
  rules_[std::minmax(kind_a, kind_b)] = rule;
}

void SceneModel::give_bad_view(std::size_t index, bool is_null) {
  ModelBody& body = bodies_[index];
  const std::size_t count = body.mesh->vertex_count() + (is_null ? 0U : 1U);
  const Positions positions(count, Eigen::Vector3d::Zero());
  const PositionView view =
      is_null ? PositionView(static_cast<const double*>(nullptr), count) : PositionView(positions);
  scene_.bind_positions(body.id, view);
  if (deformable(index) != nullptr)
    expect_diagnostic(body.id, is_null ? DiagnosticKind::null_memory : DiagnosticKind::wrong_count);
}

void SceneModel::read_bound(ModelBody& body) {
  if (body.policy == BindPolicy::when_told && !body.is_told) return;
  const Positions positions = body.memory();
  body.is_frozen = !body.can_take(positions);
  if (body.is_frozen) return expect_diagnostic(body.id, problem_of(*body.mesh, positions));
  body.is_told = false;
  body.seen = positions;
}

void SceneModel::read(ModelBody& body) {
  if (body.copied) {
    body.seen = *body.copied;
    body.copied.reset();
    body.is_frozen = false;
  } else if (body.is_bound) {
    read_bound(body);
  } else if (body.staged_pose) {
    const Positions positions = posed(*body.mesh, *body.staged_pose);
    body.is_frozen = !body.can_take(positions);
    if (body.is_frozen)
      expect_diagnostic(body.id, problem_of(*body.mesh, positions));
    else
      body.pose = body.staged_pose;
    body.staged_pose.reset();
  }
  body.is_promised = false;
}

/// No scene keeps where an object was before a swept one is added. An object that is frozen then may stand
/// when it is read again.
void SceneModel::read_and_sweep(ModelBody& body) {
  const bool stood_still = body.is_frozen && !body.is_unseen;
  body.is_start_known = !is_swept_added_ && (body.is_start_known || !stood_still);
  body.start = body.seen;
  body.start_pose = body.pose;
  read(body);
  if (body.is_unseen || body.jumps || body.settings.motion == Motion::fixed) {
    body.start = body.seen;
    body.start_pose = body.pose;
  }
  body.is_unseen = body.is_unseen && body.is_frozen;
  body.jumps = false;
}

}  // namespace graze::fuzz
