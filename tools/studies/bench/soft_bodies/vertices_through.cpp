#include "bench/soft_bodies/vertices_through.hpp"

#include <algorithm>

namespace graze::bench {
namespace {

SceneSettings settings_of_referee() {
  SceneSettings settings;
  settings.contact_distance = 0;
  settings.detail = ContactDetail::nearest;
  settings.threads = 1;
  return settings;
}

}  // namespace

VerticesThrough::VerticesThrough(const examples::World& world, bool (*is_out)(const Eigen::Vector3d& point))
    : world_(world), is_out_(is_out), scene_(settings_of_referee()) {
  for (const examples::Body& body : world.bodies()) {
    ObjectSettings settings;
    settings.solid = body.is_solid;
    settings.user_data = is_through_.size();
    const ObjectId id = scene_.add(body.mesh, settings);
    scene_.bind_positions(id, body.positions);
    is_through_.emplace_back(body.positions.size());
  }
}

std::size_t VerticesThrough::count() {
  for (std::size_t i = 0; i < is_through_.size(); ++i) {
    const examples::Body& body = world_.bodies()[i];
    for (std::size_t vertex = 0; vertex < body.positions.size(); ++vertex)
      is_through_[i][vertex] = body.inverse_masses[vertex] > 0 && is_out_(body.positions[vertex]);
  }
  const ReportHandle report = scene_.step();
  for (const PairReport& pair : report->pairs())
    for (const Contact& contact : report->contacts(pair)) {
      if (contact.feature_a.kind == FeatureKind::vertex && contact.side_b == Side::back &&
          world_.bodies()[pair.user_data_b].is_solid)
        is_through_[pair.user_data_a][contact.feature_a.index] = true;
      if (contact.feature_b.kind == FeatureKind::vertex && contact.side_a == Side::back &&
          world_.bodies()[pair.user_data_a].is_solid)
        is_through_[pair.user_data_b][contact.feature_b.index] = true;
    }
  std::size_t sum = 0;
  for (const std::vector<bool>& vertices : is_through_)
    sum += static_cast<std::size_t>(std::count(vertices.begin(), vertices.end(), true));
  return sum;
}

}  // namespace graze::bench
