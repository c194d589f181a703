#pragma once

#include <vector>

#include "examples/loops/instrument.hpp"
#include "examples/loops/organ_history.hpp"
#include "examples/loops/proxy.hpp"

namespace loops {

/// The forces that the hand feels at one instrument in one tick, in N.
struct Forces {
  /// From contacts that are moved to where the instrument is now.
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  /// As `moved`, if the proxy might go any way in one tick.
  Eigen::Vector3d unlimited = Eigen::Vector3d::Zero();
  /// From contacts as they were in the report.
  Eigen::Vector3d report = Eigen::Vector3d::Zero();
};

/// The 1 kHz thread's part: it reads the latest report and computes forces. It waits for nobody. It takes
/// memory only if there are more contacts than ever before.
class HapticReader {
 public:
  HapticReader(const graze::Scene& scene, OrganHistory& history, const std::vector<Instrument>& instruments,
               const std::vector<std::shared_ptr<const graze::Mesh>>& organs);

  /// Reads the latest report, and computes the forces for where the instruments are at a time in seconds.
  /// Returns false before the first report.
  bool tick(double time);

  [[nodiscard]] const Forces& forces(std::size_t instrument) const { return forces_[instrument]; }
  /// Returns where the instruments are held, and where their proxies are. graze is to see the proxy: so the
  /// contacts are those of a surface that touches, and not of one that is deep inside.
  [[nodiscard]] const std::array<Held, 2>& held() const { return held_; }
  /// Returns the frame that the last tick was about.
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  [[nodiscard]] Clock::time_point frame_begin() const { return frame_begin_; }
  /// Returns how many milliseconds latest_report() took in the last tick.
  [[nodiscard]] double read_ms() const { return read_ms_; }

 private:
  void blend_organs(double time);
  void add_planes(const graze::FrameReport& report, std::size_t instrument);

  const graze::Scene& scene_;
  OrganHistory& history_;
  const std::vector<Instrument>& instruments_;
  const std::vector<std::shared_ptr<const graze::Mesh>>& organs_;
  std::uint64_t frame_ = 0;
  Clock::time_point frame_begin_;
  double seen_ = 0;  ///< the time at which the frame was first seen, in s
  double read_ms_ = 0;
  std::vector<Eigen::Vector3f> organ_points_[2];
  std::vector<Eigen::Vector3d> instrument_points_;
  std::vector<ConstraintPlane> moved_planes_, report_planes_;
  std::array<Held, 2> held_, held_of_report_;
  std::vector<Forces> forces_;
};

/// Seconds between two frames of the simulation.
constexpr double simulation_step = 0.016;

/// User data of the scene's objects: the organs are 0 and 1, and instruments follow.
constexpr std::uint64_t first_instrument = 2;

}  // namespace loops
