#include "tools/program_report.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using io::ReportedContact;
using io::ReportedFrame;
using io::ReportedPair;
using oracle::Shape;

const ReportedPair* find_pair(const ReportedFrame& frame, std::uint32_t a, std::uint32_t b) {
  for (const ReportedPair& pair : frame.pairs)
    if (pair.a == a && pair.b == b) return &pair;
  return nullptr;
}

PairPhase phase_of(bool was_touching, bool is_touching) {
  if (is_touching) return was_touching ? PairPhase::touching : PairPhase::began;
  return was_touching ? PairPhase::ended : PairPhase::near;
}

double distance_to_segment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const double part = std::clamp((point - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
  return (point - (from + part * (to - from))).norm();
}

double distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  const bool is_over = normal.dot((b - a).cross(p - a)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
                       normal.dot((a - c).cross(p - c)) >= 0;
  if (is_over) return std::abs(normal.dot(p - a));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double distance_to_feature(const Vector3d& point, const Feature& feature, const Shape& shape) {
  const auto& positions = shape.positions;
  if (feature.kind == FeatureKind::vertex) return (point - positions[feature.index]).norm();
  if (feature.kind == FeatureKind::edge) {
    const auto [low, high] = oracle::edges_of(shape).at(feature.index);
    return distance_to_segment(point, positions[low], positions[high]);
  }
  const auto& face = shape.faces.at(feature.index);
  double least = 1e300;
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    least = std::min(
        least, distance_to_triangle(point, positions[face[0]], positions[face[i]], positions[face[i + 1]]));
  return least;
}

void check_edge_vertices(const Feature& feature, const io::EdgeVertices& vertices, const Shape& shape) {
  if (feature.kind == FeatureKind::edge) CHECK(vertices == oracle::edges_of(shape).at(feature.index));
}

void check_contact_set(const ReportedPair& pair, const Shape& a, const Shape& b, double threshold) {
  const std::vector<oracle::Named> expected = oracle::features(a, b, threshold);
  CHECK(pair.contacts.size() == expected.size());
  if (pair.contacts.size() != expected.size()) return;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Contact& contact = pair.contacts[i].contact;
    CHECK((contact.kind == expected[i].kind && contact.feature_a == expected[i].a &&
           contact.feature_b == expected[i].b));
    CHECK(std::abs(contact.distance - expected[i].distance) <= 1e-14);
    CHECK((contact.point_a - expected[i].point_a).norm() <= 1e-13);
    CHECK((contact.point_b - expected[i].point_b).norm() <= 1e-13);
    CHECK(std::abs(contact.normal.norm() - 1) <= 1e-12);
    check_edge_vertices(contact.feature_a, pair.contacts[i].edge_a, a);
    check_edge_vertices(contact.feature_b, pair.contacts[i].edge_b, b);
  }
}

void check_contact_places(const ReportedPair& pair, const Shape& a, const Shape& b, double threshold,
                          double tolerance) {
  for (const ReportedContact& reported : pair.contacts) {
    const Contact& contact = reported.contact;
    CHECK(contact.distance < threshold);
    CHECK(std::abs((contact.point_b - contact.point_a).norm() - contact.distance) <= tolerance);
    CHECK(distance_to_feature(contact.point_a, contact.feature_a, a) <= tolerance);
    CHECK(distance_to_feature(contact.point_b, contact.feature_b, b) <= tolerance);
    check_edge_vertices(contact.feature_a, reported.edge_a, a);
    check_edge_vertices(contact.feature_b, reported.edge_b, b);
  }
}

class Checker {
 public:
  Checker(const Thresholds& thresholds, double tolerance) : thresholds_(thresholds), tolerance_(tolerance) {}

  std::size_t check(const std::vector<ReportedFrame>& report, const std::vector<ExpectedShapes>& frames) {
    CHECK(report.size() == frames.size());
    if (report.size() != frames.size()) return 0;
    std::size_t contacts = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      INFO("frame " << k);
      CHECK(report[k].frame == k);
      std::size_t listed = 0;
      for (std::uint32_t a = 0; a < frames[k].size(); ++a)
        for (std::uint32_t b = a + 1; b < frames[k].size(); ++b)
          if (check_pair(report[k], a, b, frames[k])) ++listed;
      CHECK(report[k].pairs.size() == listed);
      for (const ReportedPair& pair : report[k].pairs) contacts += pair.contacts.size();
    }
    return contacts;
  }

 private:
  /// Returns whether the pair should be, and is, listed.
  bool check_pair(const ReportedFrame& frame, std::uint32_t a, std::uint32_t b,
                  const ExpectedShapes& shapes) {
    const oracle::Pair truth = oracle::surface_distance(shapes[a], shapes[b]);
    const bool is_touching = truth.pierced || truth.distance_up < thresholds_.contact_distance;
    const bool was_touching = touching_.contains({a, b});
    if (is_touching)
      touching_.insert({a, b});
    else
      touching_.erase({a, b});
    const double range = std::max(thresholds_.range, thresholds_.contact_distance);
    const bool is_listed = is_touching || was_touching || truth.distance_up < range;
    const ReportedPair* pair = find_pair(frame, a, b);
    INFO("objects " << a << " and " << b << " at distance " << truth.distance_up);
    CHECK((pair != nullptr) == is_listed);
    if (pair == nullptr) return false;
    CHECK(pair->phase == phase_of(was_touching, is_touching));
    CHECK(pair->distance.lower >= truth.distance_down - tolerance_);
    CHECK(pair->distance.upper <= truth.distance_up + tolerance_);
    CHECK(pair->distance.lower <= truth.distance_up + tolerance_);
    CHECK(pair->distance.upper >= truth.distance_down - tolerance_);
    const double slack = tolerance_ == 0 ? 1e-13 : tolerance_;
    CHECK(distance_to_feature(pair->witness.point_a, pair->witness.feature_a, shapes[a]) <= slack);
    CHECK(distance_to_feature(pair->witness.point_b, pair->witness.feature_b, shapes[b]) <= slack);
    CHECK(pair->contacts.empty() == !is_touching);
    if (tolerance_ == 0)
      check_contact_set(*pair, shapes[a], shapes[b], thresholds_.contact_distance);
    else
      check_contact_places(*pair, shapes[a], shapes[b], thresholds_.contact_distance, tolerance_);
    return is_listed;
  }

  Thresholds thresholds_;
  double tolerance_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching_;
};

}  // namespace

std::vector<ReportedFrame> read_report(const std::filesystem::path& path) {
  io::ReportReader reader(path);
  std::vector<ReportedFrame> frames;
  while (auto frame = reader.next()) frames.push_back(std::move(*frame));
  return frames;
}

std::size_t check_exactly(const std::vector<ReportedFrame>& report, const std::vector<ExpectedShapes>& frames,
                          const Thresholds& thresholds) {
  return Checker(thresholds, 0).check(report, frames);
}

std::size_t check_nearly(const std::vector<ReportedFrame>& report, const std::vector<ExpectedShapes>& frames,
                         const Thresholds& thresholds, double tolerance) {
  return Checker(thresholds, tolerance).check(report, frames);
}

}  // namespace graze::tests
