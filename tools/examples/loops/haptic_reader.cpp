#include "examples/loops/haptic_reader.hpp"

#include <algorithm>

namespace loops {
namespace {

constexpr double stiffness = 0.5;  // N/mm, between the hand and the proxy

/// The proxy keeps this distance from the organs, in mm. So it is always outside, and its closest points have
/// a direction. Without it, the direction would be undefined where the two touch.
constexpr double skin = 0.3;

/// How much of a lost skin the proxy wins back in a tick, in mm. Where it is held between two surfaces, more
/// would throw it out.
constexpr double recovery = 0.02;

/// Returns the plane that a contact sets for the hand, if `direction` and `separation` are those at the
/// proxy. The proxy itself is always in front of it, but for the recovery. So the force does not grow by
/// itself.
ConstraintPlane plane_for_hand(const Eigen::Vector3d& direction, double separation, const Held& held) {
  const double kept = std::min(skin, separation + recovery);
  return {direction, separation - kept + direction.dot(held.hand.translation() - held.proxy)};
}

/// How far the proxy moves in a tick at most, in mm: faster than the hand, but not further than the planes
/// are good for. Without friction the proxy would otherwise slide from face to face in a single tick.
constexpr double furthest_step = 0.1;

Eigen::Vector3d limited(const Eigen::Vector3d& step) {
  const double length = step.norm();
  return length > furthest_step ? Eigen::Vector3d(furthest_step / length * step) : step;
}

}  // namespace

HapticReader::HapticReader(const graze::Scene& scene, OrganHistory& history, const Watched& watched)
    : scene_(scene), history_(history), watched_(watched), forces_(watched.instruments.size()) {
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    held_[i].hand = watched.instruments[i].pose(0);
    held_[i].proxy = held_[i].hand.translation();
  }
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
  held_of_report_ = history_.at(frame_).held;
  blend_organs(time);
  history_.release();

  for (std::size_t i = 0; i < forces_.size(); ++i) {
    held_[i].hand = watched_.instruments[i].pose(time);
    add_planes_of_report(*report, i);
    add_planes_of_patch(*report, i);
    const Eigen::Vector3d& hand = held_[i].hand.translation();
    const Eigen::Vector3d way = way_to_proxy(moved_planes_);
    held_[i].proxy += limited(hand + way - held_[i].proxy);
    forces_[i].unlimited = stiffness * way;
    forces_[i].moved = stiffness * (held_[i].proxy - hand);
    forces_[i].report = stiffness * way_to_proxy(report_planes_);
  }
  return true;
}

/// Moves the organs from the frame before to this one in the time until the next is due. So they are felt one
/// frame late, but do not jump.
void HapticReader::blend_organs(double time) {
  const auto share = static_cast<float>(std::min(1.0, (time - seen_) / simulation_step));
  const Snapshot& to = history_.at(frame_);
  const Snapshot& from = frame_ > 1 ? history_.at(frame_ - 1) : to;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < organ_points_[i].size(); ++j)
      organ_points_[i][j] = from.points[i][j] + share * (to.points[i][j] - from.points[i][j]);
}

void HapticReader::add_planes_of_report(const graze::FrameReport& report, std::size_t instrument) {
  report_planes_.clear();
  for (const graze::PairReport& pair : report.pairs()) {
    // Organs were added first, so the organ is a.
    if (pair.user_data_b != first_instrument + instrument || pair.user_data_a >= first_instrument) continue;
    for (const graze::Contact& contact : report.contacts(pair))
      report_planes_.push_back(
          plane_for_hand(contact.push(), contact.separation(), held_of_report_[instrument]));
  }
}

/// Asks the patch where the instrument is now. Its organs are those of the report.
void HapticReader::add_planes_of_patch(const graze::FrameReport& report, std::size_t instrument) {
  moved_planes_.clear();
  Eigen::Isometry3d pose = held_[instrument].hand;
  pose.translation() = held_[instrument].proxy;
  instrument_points_.clear();
  for (const Eigen::Vector3d& point : watched_.instruments[instrument].mesh()->rest())
    instrument_points_.push_back(pose * point);

  const graze::Patch patch = report.patch(watched_.instrument_ids[instrument]);
  incomplete_ += !patch.contacts(pose, asked_distance, room_).complete;
  for (const graze::PatchPair& pair : room_.pairs())
    for (std::size_t organ = 0; organ < 2; ++organ) {
      if (pair.a != watched_.organ_ids[organ]) continue;
      for (const graze::Contact& contact : room_.contacts(pair)) add_moved(contact, organ, instrument);
    }
}

/// Follows a contact of the patch to where the organ is now.
void HapticReader::add_moved(const graze::Contact& contact, std::size_t organ, std::size_t instrument) {
  if (contact.kind == graze::ContactKind::EF) return;  // what pierces says no depth
  const auto take = [&](const graze::FollowedContact& now) {
    if (now.is_known)
      moved_planes_.push_back(plane_for_hand(now.geometry.push, now.geometry.separation, held_[instrument]));
  };
  const graze::Mesh& mesh = *watched_.instruments[instrument].mesh();
  take(graze::follow(*watched_.organs[organ], organ_points_[organ], mesh, instrument_points_, contact));
  if (contact.kind == graze::ContactKind::VV)
    take(graze::follow_vertex_of_b(*watched_.organs[organ], organ_points_[organ], mesh, instrument_points_,
                                   contact));
}

}  // namespace loops
