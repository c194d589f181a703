#include "scene_calls.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <graze/enumerators.hpp>
#include <limits>

#include "models/models.hpp"

namespace graze::fuzz {
namespace {

constexpr std::size_t most_alive = 4;
constexpr std::size_t most_bodies = 16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A small multiple of 1/8.
double small(ByteReader& reader) {
  return reader.raw<std::int8_t>() / 8.0;
}

Eigen::Vector3d small_vector(ByteReader& reader) {
  const double x = small(reader);
  const double y = small(reader);
  return {x, y, small(reader)};
}

/// Now and then what no scene takes.
double length(ByteReader& reader) {
  const std::uint8_t byte = reader.byte();
  if (byte == 255) return nan;
  if (byte == 254) return -1;
  if (byte == 253) return std::numeric_limits<double>::infinity();
  return byte / 64.0;
}

void move_all(Positions& positions, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& position : positions) position += by;
}

models::MeshData random_faces(ByteReader& reader) {
  models::MeshData data;
  const std::uint32_t vertices = 3 + reader.below(8);
  for (std::uint32_t i = 0; i < vertices; ++i) data.positions.push_back(small_vector(reader) / 8);
  data.positions.emplace_back(nan, nan, nan);  // no face uses it
  for (std::uint32_t faces = 1 + reader.below(6); faces > 0; --faces) {
    const std::uint32_t corners = 3 + reader.below(2);
    for (std::uint32_t corner = 0; corner < corners; ++corner) data.corners.push_back(reader.below(vertices));
    data.corner_counts.push_back(corners);
  }
  return data;
}

std::shared_ptr<const Mesh> read_mesh(ByteReader& reader) {
  const auto faces = reader.flag() ? models::Faces::quads : models::Faces::triangles;
  const std::uint32_t kind = reader.below(6);
  models::MeshData data;
  if (kind == 0) data = models::sheet(1 + reader.below(6), 1 + reader.below(6), 2, 2, faces);
  if (kind == 1) data = models::sphere(3 + reader.below(5), 1 + reader.below(6), faces);
  if (kind == 2) data = models::torus(3 + reader.below(6), 3 + reader.below(5), 0.75, 0.25, faces);
  if (kind == 3) data = models::box({1, 0.5, 2}, faces);
  move_all(data.positions, small_vector(reader) / 8);
  if (kind > 3) data = random_faces(reader);
  return std::make_shared<const Mesh>(Mesh::from_polygons(data.positions, data.corners, data.corner_counts));
}

/// Mostly no groups, and now and then one too few.
std::vector<std::uint8_t> read_face_groups(ByteReader& reader, const Mesh& mesh) {
  if (!reader.once_in(3)) return {};
  std::vector<std::uint8_t> groups(mesh.face_count() - (reader.once_in(64) ? 1 : 0));
  for (std::uint8_t& group : groups) group = static_cast<std::uint8_t>(reader.below(3));
  return groups;
}

/// Mostly none, and now and then one that no face has.
std::vector<std::uint8_t> read_hidden_groups(ByteReader& reader) {
  std::vector<std::uint8_t> groups;
  if (reader.once_in(4)) groups.assign(1 + reader.below(2), static_cast<std::uint8_t>(reader.below(4)));
  return groups;
}

ObjectSettings read_object_settings(ByteReader& reader) {
  ObjectSettings settings;
  const std::uint32_t motion = reader.below(4);
  settings.motion = motion < 2 ? Motion::deformable : motion == 2 ? Motion::rigid : Motion::fixed;
  if (reader.once_in(4)) {
    settings.layer = reader.below(4);
    settings.collides_with = reader.below(4);
    settings.margin = length(reader) / 4;
    settings.kind = reader.below(300) % 3 + (reader.once_in(64) ? 255 : 0);
  }
  settings.solid = reader.once_in(3);
  const std::uint32_t asks = reader.below(8);
  settings.queries = asks >= 6;
  settings.self = asks % 3 == 1;
  if (asks % 4 == 1) settings.patch_radius = reader.below(64) / 32.0;
  if (asks == 5) settings.patch_faces = 1 + reader.below(8);
  // Mostly none of a scene is swept, since steps then survey nothing and read all that promises are about.
  settings.swept = reader.once_in(6);
  if (settings.self) {
    settings.self_rings = reader.below(3) + (reader.once_in(64) ? 8 : 0);
    settings.self_at_rest = reader.flag();
  }
  return settings;
}

/// Chooses the next positions of a body. It moves a little or far, shrinks into a point, turns inside out,
/// returns to rest, or moves one vertex. Now and then one vertex is one that no object takes.
Positions next_positions(ByteReader& reader, const ModelBody& body) {
  Positions positions = body.seen;
  const std::span<const Eigen::Vector3d> rest = body.mesh->rest();
  const std::uint32_t way = reader.below(10);
  const auto vertex = reader.below(static_cast<std::uint32_t>(positions.size()));
  if (way == 0) move_all(positions, small_vector(reader) / 16);
  if (way == 1) move_all(positions, small_vector(reader));
  if (way == 2) positions.assign(rest.begin(), rest.end());
  if (way == 3)
    positions.assign(positions.size(), positions[vertex].allFinite() ? positions[vertex] : rest[0]);
  if (way == 4)
    for (Eigen::Vector3d& position : positions) position = -position;
  if (way == 5)
    for (Eigen::Vector3d& position : positions) position += 0x1p-20 * small_vector(reader);
  if (way == 6) positions[vertex] = small_vector(reader);
  if (way == 7) {
    positions.assign(rest.begin(), rest.end());
    move_all(positions, small_vector(reader) / 4);
  }
  if (way == 8) positions[vertex] *= std::ldexp(1.0, reader.raw<std::int8_t>());
  if (way == 9 && reader.once_in(2)) positions[vertex].y() = reader.flag() ? nan : 0x1p121;
  return positions;
}

Promise read_promise(ByteReader& reader) {
  const std::uint32_t promise = reader.below(16);
  if (promise == 15) return Promise::senseless;
  if (promise == 14) return Promise::jump;
  return promise % 2 == 0 ? Promise::none : Promise::kept;
}

void set_pose(ByteReader& reader, SceneModel& model, std::size_t body) {
  const Eigen::Vector3d axis = small_vector(reader);
  const double angle = reader.flag() ? small(reader) : std::acos(-1.0) / 2 * reader.below(4);
  const std::uint32_t fault = reader.below(32);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (axis.norm() > 0) turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  Eigen::Vector3d place = small_vector(reader) / 4;
  if (fault == 31) turn *= 1 + 1e-2;
  if (fault == 30) turn.col(0) = -turn.col(0);
  if (fault == 29) place.x() = nan;
  if (fault == 28) place.z() = 0x1p121;  // a rotation, but what it places is not taken
  if (fault == 27) turn *= 1 + 1e-4;     // near enough
  PoseRows rows{};
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      rows[static_cast<std::size_t>(row * 4 + column)] = column == 3 ? place[row] : turn(row, column);
  model.set_pose(body, rows, fault < 29, fault % 8 == 2);
}

void add(ByteReader& reader, SceneModel& model) {
  std::size_t alive = 0;
  for (const ModelBody& body : model.bodies()) alive += body.is_alive ? 1 : 0;
  if (alive < most_alive && model.bodies().size() < most_bodies) {
    auto mesh = read_mesh(reader);
    ObjectSettings settings = read_object_settings(reader);
    settings.face_groups = read_face_groups(reader, *mesh);
    settings.hidden_groups = read_hidden_groups(reader);
    model.add(std::move(mesh), settings);
  }
}

/// Maps vertices at random, and now and then not as a map must be.
void replace_mesh(ByteReader& reader, SceneModel& model, std::size_t body) {
  const std::shared_ptr<const Mesh> mesh = read_mesh(reader);
  std::vector<std::uint32_t> new_of_old(model.bodies()[body].mesh->vertex_count() +
                                        (reader.once_in(64) ? 1 : 0));
  const std::uint32_t count = mesh->vertex_count() + (reader.once_in(64) ? 1 : 0);
  const bool is_shift = reader.flag();
  for (std::uint32_t i = 0; i < new_of_old.size(); ++i) {
    const std::uint32_t vertex = is_shift ? i : reader.below(count + 1);
    new_of_old[i] = vertex < count ? vertex : Mesh::no_vertex;
  }
  model.replace_mesh(body, mesh, new_of_old, read_face_groups(reader, *mesh));
}

}  // namespace

SceneSettings read_scene_settings(ByteReader& reader) {
  SceneSettings settings;
  settings.detail = enumerators<ContactDetail>[reader.below(enumerators<ContactDetail>.size())];
  settings.contact_distance = reader.below(64) / 64.0;
  settings.range = reader.below(64) / 16.0;
  if (reader.once_in(8)) settings.range = std::numeric_limits<double>::infinity();
  settings.threads = 1 + reader.below(2);
  const std::uint32_t accuracy = reader.below(8);
  if (accuracy == 6) settings.accuracy = Accuracy::within(reader.below(64) / 64.0);
  const bool is_about_vertices =
      settings.detail == ContactDetail::regions || settings.detail == ContactDetail::vertices;
  if (accuracy == 7 && is_about_vertices)
    settings.accuracy = Accuracy::paper({2, 1, reader.below(64) / 64.0});
  if (reader.once_in(8)) settings.max_contacts_per_pair = 1 + reader.below(8);
  if (reader.once_in(8)) settings.max_contacts = 1 + reader.below(32);
  settings.ways_out = reader.flag();
  if (reader.once_in(4)) settings.carrying = 1 + reader.below(6);
  if (reader.once_in(8)) settings.carrying_band = reader.below(64) / 64.0;
  if (reader.once_in(4)) settings.swept_gap = reader.below(64) / 64.0;
  if (reader.once_in(4)) settings.sweep_tolerance = std::ldexp(1.0, -static_cast<int>(reader.below(53)));
  if (reader.once_in(16)) settings.work_budget = reader.below(64);
  if (reader.once_in(32)) settings.time_budget = std::chrono::microseconds(0);
  return settings;
}

void make_call(ByteReader& reader, SceneModel& model) {
  const std::uint32_t call = reader.below(24);
  if (call == 0 || model.bodies().empty()) return add(reader, model);
  const auto any_body = [&] { return reader.below(static_cast<std::uint32_t>(model.bodies().size())); };
  const std::size_t body = any_body();
  const ModelBody& chosen = model.bodies()[body];
  if (call == 1) return model.remove(body);
  if (call == 2) return model.set_ignored(body, any_body(), reader.flag());
  if (call == 3) {
    PairRule rule;
    if (reader.flag()) rule.contact_distance = length(reader);
    if (reader.flag()) rule.range = length(reader);
    const std::uint32_t kind = reader.below(3);
    return model.set_rule(kind, reader.below(300) % 3, rule);
  }
  if (call == 4) return model.unbind(body);
  if (call == 5) return model.give_bad_view(body, reader.flag());
  if (call < 8) {
    const auto policy = reader.flag() ? BindPolicy::every_step : BindPolicy::when_told;
    const bool as_floats = reader.flag();
    return model.bind(body, next_positions(reader, chosen), as_floats, policy);
  }
  if (call < 14) {
    if (chosen.settings.motion != Motion::deformable) return set_pose(reader, model, body);
    const Positions positions = next_positions(reader, chosen);
    if (!chosen.is_bound) return model.set_positions(body, positions, read_promise(reader));
    const bool tell = reader.flag();
    return model.write(body, positions, tell, read_promise(reader));
  }
  if (call == 14) return set_pose(reader, model, body);
  if (call == 15) return replace_mesh(reader, model, body);
  if (call == 16) {
    const auto group = static_cast<std::uint8_t>(reader.below(3));
    const auto other = static_cast<std::uint8_t>(reader.below(3));
    return model.set_ignored_groups({body, group}, {any_body(), other}, reader.flag());
  }
  model.step();
}

}  // namespace graze::fuzz
