#include "bench/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "output/text.hpp"

namespace graze::bench {
namespace {

using tools::format;

/// The error of distances that plain double itself makes in scenes of this size.
constexpr double lost_in_double = 1e-12;

auto key(const TrianglePair& pair) {
  return std::tuple(pair.object_a, pair.object_b, pair.triangle_a, pair.triangle_b);
}
auto key(const ObjectDistance& pair) {
  return std::pair(pair.object_a, pair.object_b);
}

template <typename Pair>
void sort_by_key(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return key(a) < key(b); });
}

std::string name_of(const TrianglePair& pair) {
  return format("triangles %u and %u of objects %u and %u", pair.triangle_a, pair.triangle_b, pair.object_a,
                pair.object_b);
}

/// The faces that a feature belongs to.
std::vector<std::uint32_t> faces_of(const Mesh& mesh, const FeaturePair::Feature& feature) {
  std::span<const std::uint32_t> faces;
  if (feature.dimension == 2) return {feature.index};
  if (feature.dimension == 1) faces = mesh.edge_faces(feature.index);
  if (feature.dimension == 0) faces = mesh.vertex_faces(feature.index);
  return {faces.begin(), faces.end()};
}

}  // namespace

Verification::Verification(const BenchScene& scene, Task task, std::unique_ptr<Contender> oracle)
    : scene_(scene), task_(task), oracle_(std::move(oracle)) {}

void Verification::update() {
  truth_.clear();
  oracle_->frame();
  oracle_->collect(truth_);
  std::sort(truth_.vertex_pairs.begin(), truth_.vertex_pairs.end());
  sort_by_key(truth_.triangle_pairs);
}

std::string Verification::complaint(Found& found, double precision) const {
  if (task_ == Task::A) return about_vertices(found);
  if (task_ == Task::D) return about_distances(found, precision + lost_in_double);
  if (!found.triangle_pairs.empty() || found.feature_pairs.empty())
    return about_triangles(found, precision + lost_in_double);
  return about_features(found);
}

std::string Verification::about_vertices(Found& found) const {
  std::sort(found.vertex_pairs.begin(), found.vertex_pairs.end());
  if (found.vertex_pairs == truth_.vertex_pairs) return {};
  std::vector<VertexPair> missed, extra;
  std::set_difference(truth_.vertex_pairs.begin(), truth_.vertex_pairs.end(), found.vertex_pairs.begin(),
                      found.vertex_pairs.end(), std::back_inserter(missed));
  std::set_difference(found.vertex_pairs.begin(), found.vertex_pairs.end(), truth_.vertex_pairs.begin(),
                      truth_.vertex_pairs.end(), std::back_inserter(extra));
  return format("%zu of %zu vertex pairs missed, %zu too many", missed.size(), truth_.vertex_pairs.size(),
                extra.size());
}

std::string Verification::about_triangles(Found& found, double precision) const {
  sort_by_key(found.triangle_pairs);
  if (found.triangle_pairs.size() != truth_.triangle_pairs.size())
    return format("%zu triangle pairs in place of %zu", found.triangle_pairs.size(),
                  truth_.triangle_pairs.size());
  for (std::size_t i = 0; i < truth_.triangle_pairs.size(); ++i) {
    const TrianglePair& truth = truth_.triangle_pairs[i];
    const TrianglePair& answer = found.triangle_pairs[i];
    if (key(answer) != key(truth)) return "missed " + name_of(truth) + " or has others";
    if (!(std::abs(answer.distance - truth.distance) <= precision))
      return format("%s are %.17g apart, not %.17g", name_of(truth).c_str(), truth.distance, answer.distance);
  }
  return {};
}

/// Closest features belong to pairs of triangles: each such pair must be among the near ones and no farther
/// than the features, and the nearest features of each near pair must be as near as it is.
std::string Verification::about_features(const Found& found) const {
  const std::vector<TrianglePair>& pairs = truth_.triangle_pairs;
  std::vector<double> least(pairs.size(), std::numeric_limits<double>::infinity());
  for (const FeaturePair& contact : found.feature_pairs) {
    const auto faces_b = faces_of(*scene_.bodies[contact.object_b].mesh, contact.feature_b);
    for (const std::uint32_t face_a : faces_of(*scene_.bodies[contact.object_a].mesh, contact.feature_a))
      for (const std::uint32_t face_b : faces_b) {
        const TrianglePair wanted{contact.object_a, contact.object_b, face_a, face_b, 0};
        const auto place =
            std::lower_bound(pairs.begin(), pairs.end(), wanted,
                             [](const TrianglePair& a, const TrianglePair& b) { return key(a) < key(b); });
        if (place == pairs.end() || key(*place) != key(wanted))
          return format("features are %.17g apart, but their %s are not near", contact.distance,
                        name_of(wanted).c_str());
        if (!(contact.distance >= place->distance - lost_in_double))
          return format("features are %.17g apart, but their %s are %.17g", contact.distance,
                        name_of(wanted).c_str(), place->distance);
        double& distance = least[static_cast<std::size_t>(place - pairs.begin())];
        distance = std::min(distance, contact.distance);
      }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!(std::abs(least[i] - pairs[i].distance) <= lost_in_double))
      return format("%s are %.17g apart, but their nearest features %.17g", name_of(pairs[i]).c_str(),
                    pairs[i].distance, least[i]);
  return {};
}

std::vector<ObjectDistance> Verification::least_distances() const {
  std::vector<ObjectDistance> result;
  for (const TrianglePair& pair : truth_.triangle_pairs) {
    if (result.empty() || key(result.back()) != std::pair(pair.object_a, pair.object_b))
      result.push_back({pair.object_a, pair.object_b, pair.distance, pair.distance});
    result.back().lower = result.back().upper = std::min(result.back().lower, pair.distance);
  }
  return result;
}

std::string Verification::about_distances(Found& found, double precision) const {
  sort_by_key(found.distances);
  const std::vector<ObjectDistance> truth = least_distances();
  if (found.distances.size() != truth.size())
    return format("%zu pairs of objects in place of %zu", found.distances.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const ObjectDistance& answer = found.distances[i];
    if (key(answer) != key(truth[i]) || !(answer.lower <= truth[i].lower + precision) ||
        !(answer.upper >= truth[i].upper - precision) || !(answer.upper - answer.lower <= precision))
      return format("objects %u and %u are %.17g apart, not %.17g", truth[i].object_a, truth[i].object_b,
                    truth[i].lower, answer.lower);
  }
  return {};
}

}  // namespace graze::bench
