#include "examples/loops/haptic_reader.hpp"

#include <algorithm>

namespace loops {
namespace {

constexpr double stiffness = 0.5;  // N/mm, between the hand and the proxy

/// Returns the plane of a contact where both surfaces are now. The report's direction is kept: that of the closest
/// points turns quickly where they have left their features, and turns round where they change sides.
ConstraintPlane moved_plane(const graze::Contact& contact, const graze::ContactGeometry& now) {
  ConstraintPlane plane;
  plane.direction = contact.push();
  plane.separation = plane.direction.dot(now.point_b - now.point_a);
  return plane;
}

}  // namespace

HapticReader::HapticReader(const graze::Scene& scene, OrganHistory& history,
                           const std::vector<Instrument>& instruments,
                           const std::vector<std::shared_ptr<const graze::Mesh>>& organs)
    : scene_(scene), history_(history), instruments_(instruments), organs_(organs), forces_(instruments.size()) {
  for (std::size_t i = 0; i < 2; ++i) organ_points_[i] = history.at(0).points[i];
  moved_planes_.reserve(4096);
  report_planes_.reserve(4096);
  instrument_points_.reserve(1024);
}

bool HapticReader::tick(double time) {
  const Clock::time_point start = Clock::now();
  graze::ReportHandle report = scene_.latest_report();
  read_ms_ = milliseconds(start, Clock::now());
  if (report->frame() == 0) return false;
  while (!history_.hold(report->tag())) report = scene_.latest_report();
  if (report->tag() != frame_) seen_ = time;
  frame_ = report->tag();
  frame_begin_ = history_.at(frame_).begin;
  blend_organs(time);
  history_.release();

  for (std::size_t i = 0; i < instruments_.size(); ++i) {
    add_planes(*report, i, instruments_[i].pose(time));
    forces_[i].moved = stiffness * way_to_proxy(moved_planes_);
    forces_[i].report = stiffness * way_to_proxy(report_planes_);
  }
  return true;
}

/// Moves the organs from the frame before to this one in the time until the next is due. So they are felt one frame
/// late, but do not jump.
void HapticReader::blend_organs(double time) {
  const auto share = static_cast<float>(std::min(1.0, (time - seen_) / simulation_step));
  const Snapshot& to = history_.at(frame_);
  const Snapshot& from = frame_ > 1 ? history_.at(frame_ - 1) : to;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < organ_points_[i].size(); ++j)
      organ_points_[i][j] = from.points[i][j] + share * (to.points[i][j] - from.points[i][j]);
}

void HapticReader::add_planes(const graze::FrameReport& report, std::size_t instrument,
                              const Eigen::Isometry3d& pose) {
  moved_planes_.clear();
  report_planes_.clear();
  const graze::Mesh& mesh = *instruments_[instrument].mesh();
  instrument_points_.clear();
  for (const Eigen::Vector3d& point : mesh.rest()) instrument_points_.push_back(pose * point);

  for (const graze::PairReport& pair : report.pairs()) {
    // Organs were added first, so the organ is a.
    if (pair.user_data_b != first_instrument + instrument || pair.user_data_a >= first_instrument) continue;
    for (const graze::Contact& contact : report.contacts(pair)) {
      // Only the instrument's own vertices are points of the proxy. An organ's vertex inside the rod would push it
      // sideways, by the shortest way out of the rod, and against what its vertices say.
      if (contact.feature_b.kind != graze::FeatureKind::vertex) continue;
      report_planes_.push_back({contact.push(), contact.separation()});
      const graze::ContactGeometry now =
          graze::evaluate(*organs_[pair.user_data_a], organ_points_[pair.user_data_a], contact.feature_a, mesh,
                          instrument_points_, contact.feature_b);
      moved_planes_.push_back(moved_plane(contact, now));
    }
  }
}

}  // namespace loops
