#include "experiment/speed/vertex_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace graze::tools {
namespace {

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;

/// Squared distances in double are this exact, relatively: what is nearer to the limit is not decided here.
constexpr double rounding = 1e-12;

struct BruteForce {
  std::set<VertexPair> below;  ///< certainly closer than the contact distance
  std::set<VertexPair> ties;
  double distance = 0;
};

std::vector<Eigen::Vector3d> points_of(const RecordedObject& object, std::size_t frame) {
  const PositionView view = object.positions(frame);
  std::vector<Eigen::Vector3d> points(view.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = view[i];
  return points;
}

BruteForce all_against_all(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
                           double threshold) {
  const double limit = threshold * threshold;
  double least = std::numeric_limits<double>::infinity();
  BruteForce found;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const double squared = (a[i] - b[j]).squaredNorm();
      least = std::min(least, squared);
      if (squared > limit * (1 + rounding)) continue;
      (squared < limit * (1 - rounding) ? found.below : found.ties).emplace(i, j);
    }
  found.distance = std::sqrt(least);
  return found;
}

bool agrees(const FrameReport& report, const PairReport& row, const BruteForce& truth) {
  std::set<VertexPair> left = truth.below;
  for (const Contact& contact : report.contacts(row)) {
    const VertexPair pair(contact.feature_a.index, contact.feature_b.index);
    if (left.erase(pair) == 0 && !truth.ties.contains(pair)) return false;
  }
  const double slack = rounding * truth.distance;
  return left.empty() && row.distance.lower <= truth.distance + slack &&
         row.distance.upper >= truth.distance - slack && row.distance.upper - row.distance.lower <= slack;
}

}  // namespace

VertexTruth check_vertex_truth(const RecordedMotion& motion, const ModeStudy& study, std::uint32_t frames) {
  VertexTruth result;
  const std::size_t count = motion.frame_count();
  const std::size_t every = std::max<std::size_t>(1, count / frames);
  for (std::size_t frame = (count - 1) % every; frame < count; frame += every) {
    const FrameReport& report = *study.truth(ContactDetail::vertices)[frame];
    std::vector<std::vector<Eigen::Vector3d>> points;
    for (const RecordedObject& object : motion.objects) points.push_back(points_of(object, frame));
    std::size_t row = 0;  // pairs are in the order in which the objects were added, each listed
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = a + 1; b < points.size(); ++b, ++row) {
        const BruteForce truth = all_against_all(points[a], points[b], study.contact_distance());
        ++result.pairs;
        result.contacts += truth.below.size();
        result.ties += truth.ties.size();
        result.wrong += agrees(report, report.pairs()[row], truth) ? 0U : 1U;
      }
  }
  return result;
}

}  // namespace graze::tools
