// The pairs of edges of `nearest` in scenes that live for some steps, against brute force in exact
// arithmetic: rigid and deformable objects, groups, 1 and 4 threads, every instruction set.

#include <Eigen/Geometry>
#include <algorithm>
#include <graze/instruction_set.hpp>
#include <utility>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/edge_comparison.hpp"
#include "support/effort.hpp"
#include "support/random/random_creases.hpp"

namespace graze::tests {
namespace {

using oracle::Creases;
using oracle::Random;
using oracle::Shape;

/// Where a rigid object's vertices are, as the documentation of poses has it.
Shape posed(Shape shape, const Eigen::Isometry3d& pose) {
  const auto& m = pose.matrix();
  for (Eigen::Vector3d& p : shape.positions) {
    const Eigen::Vector3d at = p;
    for (int row = 0; row < 3; ++row) {
      const double x = m(row, 0) * at.x();
      const double y = m(row, 1) * at.y();
      const double z = m(row, 2) * at.z();
      p[row] = ((x + y) + z) + m(row, 3);
    }
  }
  return shape;
}

/// Three objects at a time, of which the last two move. Plays the same steps in any scene.
class EdgePlay {
 public:
  explicit EdgePlay(std::uint64_t seed) : seed_(seed) {
    const oracle::CreaseScene given = oracle::random_creases(seed);
    const oracle::CreaseScene other = oracle::random_creases(seed + 500'000);
    threshold_ = given.threshold;
    rest_ = {given.rest_a, given.rest_b, other.rest_b};
    now_ = {given.a, given.b, other.b};
    Random random(seed);
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      std::vector<std::uint8_t> groups;
      for (std::size_t face = 0; face < rest_[i].faces.size(); ++face)
        groups.push_back(random.chance(0.8) ? 0 : 1);
      groups_.push_back(std::move(groups));
    }
    has_groups_ = random.chance(0.4);
    is_rigid_ = random.chance(0.5);
  }

  struct Step {
    ReportHandle report;
    std::vector<Shape> now;
  };
  /// The reports of some steps, and where everything was.
  [[nodiscard]] std::vector<Step> play(unsigned threads, ContactDetail detail) const {
    SceneSettings settings = settings_of(threshold_, 2 * threshold_, detail);
    settings.threads = threads;
    Scene scene(settings);
    std::vector<ObjectId> ids;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      ObjectSettings object = motion_of(is_rigid(i) ? Motion::rigid : Motion::deformable);
      object.face_groups = groups_[i];
      ids.push_back(scene.add(mesh_of(rest_[i]), object));
    }
    if (has_groups_) scene.ignore(ids[0], 1, ids[1], 0);
    if (has_groups_) scene.ignore(ids[1], 1, ids[2], 1);
    Random random(seed_ + 9);
    std::vector<Shape> now = now_;
    Eigen::Isometry3d pose = first_pose();
    std::vector<Step> steps;
    for (int step = 0; step < 5; ++step) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (is_rigid(i)) {
          scene.set_pose(ids[i], pose);
          now[i] = posed(rest_[i], pose);
        } else {
          scene.set_positions(ids[i], now[i].positions);
        }
      }
      steps.push_back({scene.step(), now});
      const double size = 0.2 * threshold_;
      pose.translation() += random.vector(-size, size);
      pose.linear() =
          (pose.linear() * Eigen::AngleAxisd(random.chance(0.5) ? 1e-6 : 0.01, Eigen::Vector3d::UnitX()))
              .eval();
      for (Eigen::Vector3d& position : now[2].positions) position += random.vector(-size, size) / 4;
    }
    return steps;
  }

  /// Compares all pairs of all steps with brute force.
  void check(const std::vector<Step>& steps, ContactDetail detail, EdgeTally& tally) const {
    for (std::size_t step = 0; step < steps.size(); ++step) {
      const std::vector<Shape>& now = steps[step].now;
      std::size_t compared = 0;
      for (std::uint32_t a = 0; a < now.size(); ++a)
        for (std::uint32_t b = a + 1; b < now.size(); ++b) {
          INFO("seed " << seed_ << ", step " << step << ", objects " << a << " and " << b);
          const oracle::FacePairs pairs = pairs_of(a, b);
          const auto contacts = contacts_of(*steps[step].report, a, b);
          if (!pairs.are_some()) {
            CHECK(contacts.empty());
            continue;
          }
          const auto expected = edge_pairs_of(now[a], now[b], threshold_, Creases(rest_[a], rest_[b]), pairs);
          tally.count(expected);
          CHECK(edge_difference(detail, contacts, expected, {now[a], now[b]}) == "");
          compared += contacts.size();
        }
      CHECK(compared == steps[step].report->contacts().size());
    }
  }

 private:
  [[nodiscard]] bool is_rigid(std::size_t object) const { return is_rigid_ && object == 1; }
  [[nodiscard]] Eigen::Isometry3d first_pose() const {
    // Where the scene has its second object, up to a turn.
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = now_[1].positions[0] - rest_[1].positions[0];
    return pose;
  }
  [[nodiscard]] oracle::FacePairs pairs_of(std::uint32_t a, std::uint32_t b) const {
    return {rest_[a], rest_[b], [&](std::uint32_t face_a, std::uint32_t face_b) {
              const auto group_a = groups_[a][face_a];
              const auto group_b = groups_[b][face_b];
              if (!has_groups_) return true;
              if (a == 0 && b == 1) return !(group_a == 1 && group_b == 0);
              return !(a == 1 && b == 2 && group_a == 1 && group_b == 1);
            }};
  }
  /// Ids are given in the order in which objects are added.
  static std::span<const Contact> contacts_of(const FrameReport& report, std::uint32_t a, std::uint32_t b) {
    for (const PairReport& row : report.pairs())
      if (row.a.index == a && row.b.index == b) return report.contacts(row);
    return {};
  }

  std::uint64_t seed_;
  double threshold_ = 0;
  std::vector<Shape> rest_;
  std::vector<Shape> now_;
  std::vector<std::vector<std::uint8_t>> groups_;
  bool has_groups_ = false;
  bool is_rigid_ = false;
};

/// Requires that two plays gave the same reports.
void require_same(const std::vector<EdgePlay::Step>& steps, const std::vector<EdgePlay::Step>& others) {
  REQUIRE(steps.size() == others.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    INFO("step " << i);
    REQUIRE(difference_of(*steps[i].report, *others[i].report) == "");
  }
}

}  // namespace

TEST_CASE("edges of nearest: living scenes are those of brute force, at 1 and 4 threads") {
  EdgeTally tally;
  for (std::uint64_t seed = 2'000'000; seed < 2'000'015 + repeats(135); ++seed) {
    const ContactDetail detail = seed % 4 == 0 ? ContactDetail::features : ContactDetail::nearest;
    const EdgePlay play(seed);
    const auto steps = play.play(1, detail);
    play.check(steps, detail, tally);
    INFO("seed " << seed);
    require_same(play.play(4, detail), steps);
  }
  CHECK(tally.judged > repeats(10'000));
  CHECK(tally.patches_only > repeats(500));
  CHECK(tally.sunk_and_listed > repeats(50));
  tally.print("scenes of three objects in five steps");
}

TEST_CASE("edges of nearest: every instruction set lists those of brute force") {
  const InstructionSet before = instruction_set();
  EdgeTally tally;
  for (std::uint64_t seed = 3'000'000; seed < 3'000'030; ++seed) {
    const EdgePlay play(seed);
    use_instruction_set(InstructionSet::scalar);
    const auto steps = play.play(1, ContactDetail::nearest);
    play.check(steps, ContactDetail::nearest, tally);
    for (const InstructionSet set : available_instruction_sets()) {
      use_instruction_set(set);
      INFO("seed " << seed << ", " << to_string(set));
      require_same(play.play(2, ContactDetail::nearest), steps);
    }
  }
  use_instruction_set(before);
  CHECK(tally.patches_only > 100);
  tally.print("scenes with every instruction set");
}

}  // namespace graze::tests
