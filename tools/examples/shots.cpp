// Boxes of 10 cm and balls of 4 cm are shot at a wall of 10 cm and at an open sheet, at 60 Hz. Some fly
// further in a frame than target and projectile are thick. A loop that looks at the end of each frame lets
// some of them pass. A loop that stops at each impact lets none pass, at any of 20 speeds.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <random>

#include "examples/support/projectile.hpp"
#include "examples/support/record_option.hpp"
#include "examples/support/shapes.hpp"

namespace {

using examples::Projectile;

constexpr double frame = 1.0 / 60;  // s
constexpr double skin = 0.002;      // m, left between the two at an impact
constexpr int most_impacts = 8;     // in a frame. The rest of its time is lost
constexpr double most_turn = 0.5;   // rad, in one sweep
constexpr int speeds = 20;
constexpr int shots = 40;  // of each speed

/// A target that lies in the plane z = 0, and what is shot at it from above.
class ShootingRange {
 public:
  ShootingRange(const examples::Shape& target, const examples::Shape& projectile, bool is_solid,
                bool by_impacts)
      : by_impacts_(by_impacts) {
    scene.add(examples::mesh_of(target),
              {.name = "target", .motion = graze::Motion::fixed, .solid = is_solid});
    id_ =
        scene.add(examples::mesh_of(projectile),
                  {.name = "projectile", .motion = graze::Motion::rigid, .solid = true, .swept = by_impacts});
  }

  /// Returns whether a projectile passes the target.
  bool passes(Projectile body) {
    scene.set_pose(id_, body.pose, graze::teleport);
    scene.step();
    for (int i = 0; i < 60 && std::abs(body.pose.translation().z()) < 1.5; ++i)
      by_impacts_ ? fly_by_impacts(body) : fly(body);
    return body.pose.translation().z() < 0;
  }

  graze::Scene scene{graze::SceneSettings{
      .contact_distance = 0.02, .detail = graze::ContactDetail::nearest, .threads = 1, .ways_out = true}};
  int intersecting = 0;  ///< steps after which the two pierce each other
  int lost = 0;          ///< frames of which time was lost

 private:
  /// Looks at the end of the frame, and pushes out what is too near by then.
  void fly(Projectile& body) {
    body.pose = body.after(frame);
    scene.set_pose(id_, body.pose);
    const graze::ReportHandle report = scene.step();
    Eigen::Vector3d push = Eigen::Vector3d::Zero();
    for (const graze::Contact& contact : report->contacts())
      if (skin - contact.separation() > push.norm()) push = (skin - contact.separation()) * contact.push();
    for (const graze::PairReport& pair : report->pairs())
      if (push.norm() < skin + pair.way_out.thickness / 4)
        push = (skin + pair.way_out.thickness) * pair.way_out.direction;
    respond(body, *report, skin, frame);
    body.pose.translation() += push;
  }

  /// Goes to the first impact, changes the velocity there, and goes on for the rest of the frame.
  void fly_by_impacts(Projectile& body) {
    double time = frame;
    for (int impacts = 0; time > 0 && impacts < most_impacts;) {
      const double wanted = std::min(time, most_turn / body.spin.norm());
      const double gone = advance(body, wanted);
      time -= gone;
      if (gone == wanted) continue;
      respond(body, *scene.latest_report(), skin, time);
      ++impacts;
    }
    lost += time > 0;
  }

  /// Moves for a time, or until just before the first impact. Returns for how long it moved. A sweep goes
  /// straight from pose to pose, and a turning body does not. So the shorter way is swept once more.
  double advance(Projectile& body, double time) {
    for (;;) {
      const Eigen::Isometry3d end = body.after(time);
      scene.set_pose(id_, end);
      const graze::ReportHandle report = scene.step();
      double impact = 1;
      for (const graze::PairReport& pair : report->pairs()) {
        impact = std::min(impact, pair.time_of_impact);
        intersecting += impact == 1 && pair.inside != graze::Inside::none;
      }
      if (impact == 1) {
        body.pose = end;
        return time;
      }
      scene.set_pose(id_, body.pose, graze::teleport);  // back: the next way begins here again
      scene.step();
      time = std::max(impact * time - skin / body.top_speed(), impact * time / 2);
    }
  }

  graze::ObjectId id_;
  bool by_impacts_;
};

struct Row {
  const char* name;
  const examples::Shape& target;
  const examples::Shape& projectile;
  bool is_solid;           ///< the target
  double radius, inertia;  ///< of the projectile, whose inertia is by its mass
};

bool holds(const Row& row, bool by_impacts, int argc, char** argv) {
  ShootingRange range(row.target, row.projectile, row.is_solid, by_impacts);
  const auto recorder = examples::recorder_by_options(argc, argv, range.scene);
  std::mt19937 random(1);
  int passed = 0;
  for (int i = 0; i < speeds; ++i)
    for (int k = 0; k < shots; ++k) {
      const double speed = 5 + 35.0 * i / (speeds - 1);
      passed += range.passes(examples::random_shot(speed, row.radius, row.inertia, random));
    }
  std::printf("%s, %s: %d of %d pass, %d frames lose time\n", row.name,
              by_impacts ? "stopped at impacts" : "at the end of frames", passed, speeds * shots, range.lost);
  return (passed == 0) == by_impacts && range.intersecting == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const examples::Shape box = examples::box({0.1, 0.1, 0.1});
  const examples::Shape ball = examples::ball(0.02, 12, 7);
  const examples::Shape wall = examples::box({2, 2, 0.1});
  const examples::Shape sheet = examples::sheet(2, 11);
  bool all = true;
  for (const Row& row : {Row{"boxes at a wall", wall, box, true, 0.087, 0.1 * 0.1 / 6},
                         Row{"boxes at a sheet", sheet, box, false, 0.087, 0.1 * 0.1 / 6},
                         Row{"balls at a sheet", sheet, ball, false, 0.02, 0.4 * 0.02 * 0.02}})
    for (const bool by_impacts : {false, true}) all = holds(row, by_impacts, argc, argv) && all;
  std::printf("%s\n", all ? "what is stopped at impacts does not pass" : "went wrong");
  return all ? 0 : 1;
}
