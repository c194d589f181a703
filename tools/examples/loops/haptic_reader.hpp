#pragma once

#include <graze/graze.hpp>
#include <vector>

#include "examples/loops/instrument.hpp"
#include "examples/loops/organ_history.hpp"
#include "examples/loops/proxy.hpp"

namespace loops {

/// The forces that the hand feels at one instrument in one tick, in N.
struct Forces {
  /// From contacts of the patch where the instrument is now, moved to where the organs are now.
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  /// As `moved`, if the proxy might go any way in one tick.
  Eigen::Vector3d unlimited = Eigen::Vector3d::Zero();
  /// From contacts as they were in the report.
  Eigen::Vector3d report = Eigen::Vector3d::Zero();
};

/// The objects of the scene that the 1 kHz thread reads about.
struct Watched {
  const std::vector<Instrument>& instruments;
  const std::vector<graze::ObjectId>& instrument_ids;
  const std::vector<std::shared_ptr<const graze::Mesh>>& organs;
  const std::vector<graze::ObjectId>& organ_ids;
};

/// The 1 kHz thread's part: it reads the latest report and computes forces. It waits for nobody. It takes
/// memory only if there are more contacts than ever before.
class HapticReader {
 public:
  HapticReader(const graze::Scene& scene, OrganHistory& history, const Watched& watched);

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
  /// Returns in how many ticks a patch did not know all contacts.
  [[nodiscard]] std::size_t incomplete() const { return incomplete_; }

 private:
  void blend_organs(double time);
  void add_planes_of_report(const graze::FrameReport& report, std::size_t instrument);
  void add_planes_of_patch(const graze::FrameReport& report, std::size_t instrument);
  void add_moved(const graze::Contact& contact, std::size_t organ, std::size_t instrument);

  const graze::Scene& scene_;
  OrganHistory& history_;
  const Watched watched_;
  std::uint64_t frame_ = 0;
  Clock::time_point frame_begin_;
  double seen_ = 0;  ///< the time at which the frame was first seen, in s
  double read_ms_ = 0;
  std::vector<Eigen::Vector3f> organ_points_[2];
  std::vector<Eigen::Vector3d> instrument_points_;
  graze::PatchRoom room_;
  std::size_t incomplete_ = 0;
  std::vector<ConstraintPlane> moved_planes_, report_planes_;
  std::array<Held, 2> held_, held_of_report_;
  std::vector<Forces> forces_;
};

/// Contacts are those of surfaces that are nearer than this, in mm. The instruments move up to 40 mm/s, and a
/// report is in use until 24 ms after its step began. With the proxy's skin that is 1.3 mm.
constexpr double contact_distance = 2;

/// Patches are asked for contacts of surfaces that are nearer than this, in mm. They know where the
/// instrument is now. So that is what the organs move until the next report, and the proxy's skin.
constexpr double asked_distance = 1;

/// Patches have all that is within this distance of an instrument, in mm. It leaves room for what instruments
/// and organs move until the next report.
constexpr double patch_radius = 8;

/// Seconds between two frames of the simulation.
constexpr double simulation_step = 0.016;

/// User data of the scene's objects: the organs are 0 and 1, and instruments follow.
constexpr std::uint64_t first_instrument = 2;

}  // namespace loops
