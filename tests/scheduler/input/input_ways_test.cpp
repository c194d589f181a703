// This test gives one motion to a scene in every way of input. All reports must be the same. For an object
// that is near nothing, a step must compute only the bounding box.

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sanitizers.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t count = 10;
#ifdef GRAZE_HAS_ADDRESS_SANITIZER
constexpr int step_count = 40;  // with all it would be the longest of the sanitizer's tests
#else
constexpr int step_count = 120;
#endif

enum class Way : std::uint8_t { bound, told, copied, copied_with_gaps, posed };

/// Applies a pose to a mesh by the contract's formula.
Positions placed(const Mesh& mesh, const Eigen::Isometry3d& pose) {
  const auto& m = pose.matrix();
  Positions positions;
  for (const Eigen::Vector3d& p : mesh.rest()) {
    const auto coordinate = [&](int row) {
      return ((m(row, 0) * p.x() + m(row, 1) * p.y()) + m(row, 2) * p.z()) + m(row, 3);
    };
    positions.emplace_back(coordinate(0), coordinate(1), coordinate(2));
  }
  return positions;
}

/// Bodies that drift, tremble, jump, rest, come near each other and part, the same in every scene.
class Motions {
 public:
  Motions() {
    for (Eigen::Isometry3d& pose : poses) pose.setIdentity();
    for (std::size_t i = 0; i < count; ++i) poses[i].translation() = home(i);
  }
  void advance() {
    for (std::size_t i = 0; i < count; ++i) {
      const double chance = random_.between(0, 1);
      changed[i] = chance < 0.8;
      if (chance < 0.4)
        poses[i].translation() += random_.vector(-0.02, 0.02);
      else if (chance < 0.6)
        poses[i].translation() += random_.vector(-1e-5, 1e-5);
      else if (chance < 0.7)
        poses[i].translation() = home(random_.below(count)) + random_.vector(-0.3, 0.3);
      else if (chance < 0.75)
        poses[i].translation() = home(i);
      else if (chance < 0.8)
        poses[i].linear() = Eigen::Quaterniond{random_.between(-1, 1), random_.between(-1, 1), 1, 0.5}
                                .normalized()
                                .toRotationMatrix();
    }
  }

  std::array<Eigen::Isometry3d, count> poses;
  std::array<bool, count> changed{};

 private:
  static Eigen::Vector3d home(std::size_t i) { return {3.0 * static_cast<double>(i), 0, 0}; }
  oracle::Random random_{11};
};

/// A scene that is given the motions in one way, in floats or doubles.
template <typename Number>
class Played {
 public:
  Played(Way way, const SceneSettings& settings, std::shared_ptr<const Mesh> mesh)
      : way_(way), scene_(settings), mesh_(std::move(mesh)) {
    for (std::size_t i = 0; i < count; ++i) add(i);
  }
  void add(std::size_t i) {
    ids_[i] = scene_.add(mesh_, motion_of(way_ == Way::posed ? Motion::rigid : Motion::deformable));
    memory_[i].assign(mesh_->vertex_count() * each(), std::numeric_limits<Number>::quiet_NaN());
    is_bound_[i] = false;
  }
  void remove(std::size_t i) { scene_.remove(ids_[i]); }
  void give(std::size_t i, const Eigen::Isometry3d& pose) {
    if (way_ == Way::posed) return scene_.set_pose(ids_[i], pose);
    const Positions positions = placed(*mesh_, pose);
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
      for (int axis = 0; axis < 3; ++axis)
        memory_[i][vertex * each() + static_cast<std::size_t>(axis)] =
            static_cast<Number>(positions[vertex][axis]);
    const PositionView view(memory_[i].data(), positions.size(), each() * sizeof(Number));
    if (way_ == Way::copied || way_ == Way::copied_with_gaps) {
      scene_.set_positions(ids_[i], view);
      std::fill(memory_[i].begin(), memory_[i].end(), std::numeric_limits<Number>::quiet_NaN());
    } else if (!std::exchange(is_bound_[i], true)) {
      scene_.bind_positions(ids_[i], view,
                            way_ == Way::told ? BindPolicy::when_told : BindPolicy::every_step);
    } else {
      scene_.positions_changed(ids_[i]);
    }
  }
  ReportHandle step() { return scene_.step(); }

 private:
  [[nodiscard]] std::size_t each() const { return way_ == Way::copied_with_gaps ? 4 : 3; }

  Way way_;
  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  std::array<ObjectId, count> ids_;
  std::array<std::vector<Number>, count> memory_;
  std::array<bool, count> is_bound_{};
};

template <typename Number>
void compare_ways(const SceneSettings& settings, const std::vector<Way>& ways) {
  const auto mesh = mesh_of(models::sphere(14, 10));
  std::vector<std::unique_ptr<Played<Number>>> scenes;
  for (const Way way : ways) scenes.push_back(std::make_unique<Played<Number>>(way, settings, mesh));
  Motions motions;
  oracle::Random random(5);
  std::size_t contacts = 0;
  std::size_t surveyed = 0;
  for (int step = 0; step < step_count; ++step) {
    motions.advance();
    const std::size_t replaced = random.chance(0.1) ? random.below(count) : count;
    std::vector<ReportHandle> reports;
    for (auto& scene : scenes) {
      if (replaced < count) {
        scene->remove(replaced);
        scene->add(replaced);
      }
      for (std::size_t i = 0; i < count; ++i)
        if (motions.changed[i] || i == replaced) scene->give(i, motions.poses[i]);
      reports.push_back(scene->step());
    }
    for (std::size_t i = 1; i < reports.size(); ++i) {
      CAPTURE(step, static_cast<int>(ways[i]));
      REQUIRE(difference_of(*reports[i], *reports[0]).empty());
      surveyed += reports[i]->statistics().objects_surveyed;
    }
    contacts += reports[0]->contacts().size();
  }
  CHECK(surveyed > 100);
  if (settings.detail != ContactDetail::none) CHECK(contacts > 100);
}

/// Plates 10 apart, near nothing, that rise and sink.
struct Apart {
  explicit Apart(Motion motion) : scene(settings_of(0.5, 1)), mesh(mesh_of(models::sheet(20, 20, 2, 2))) {
    for (std::size_t i = 0; i < count; ++i) ids[i] = scene.add(mesh, motion_of(motion));
  }
  [[nodiscard]] Eigen::Isometry3d pose(std::size_t i, double height) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(10.0 * static_cast<double>(i), 0, height);
    return pose;
  }
  [[nodiscard]] std::size_t vertices() const { return count * mesh->vertex_count(); }

  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  std::array<ObjectId, count> ids;
};

}  // namespace

TEST_CASE("every way of input gives the same reports, bit for bit") {
  const auto detail = GENERATE(from_range(all_details));
  const auto threads = at_full_effort ? GENERATE(1U, 2U) : 2U;
  SceneSettings settings = settings_of(0.1, 0.4, detail);
  settings.threads = threads;
  compare_ways<double>(settings, {Way::bound, Way::told, Way::copied, Way::copied_with_gaps, Way::posed});
  compare_ways<float>(settings, {Way::bound, Way::told, Way::copied, Way::copied_with_gaps});
}

TEST_CASE("a posed object that is near nothing has no positions") {
  Apart apart(Motion::rigid);
  ReportHandle report;
  const auto step_at = [&](double height) {
    for (std::size_t i = 0; i < count; ++i) apart.scene.set_pose(apart.ids[i], apart.pose(i, height));
    report = apart.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(report->pairs().empty());
  };
  step_at(1);
  const std::size_t bytes_before = report->statistics().bytes.objects;
  for (const double height : {2.0, 1.5, 3.0}) {
    step_at(height);
    CHECK(report->statistics().objects_surveyed == count);
  }
  CHECK(report->statistics().bytes.objects == bytes_before);
  CHECK(bytes_before < 12 * apart.vertices() + 6144);
  // It is where it was when nothing new is said, or the same again, and is read when another comes.
  step_at(3);
  CHECK(report->statistics().objects_surveyed == 0);
  CHECK(apart.scene.step()->statistics().objects_surveyed == 0);
  apart.scene.set_pose(apart.ids[0], apart.pose(4, 3.25));
  report = apart.scene.step();
  REQUIRE(report->pairs().size() == 1);
  CHECK(report->pairs()[0].distance.upper == 0.25);
  CHECK(report->statistics().bytes.objects >= bytes_before + 2 * 24 * apart.mesh->vertex_count());
}

TEST_CASE("a rule that makes pairs near reads what was surveyed long ago") {
  Apart apart(Motion::rigid);
  for (std::size_t i = 0; i < count; ++i) apart.scene.set_pose(apart.ids[i], apart.pose(i, 1));
  for (int step = 0; step < 4; ++step) CHECK(apart.scene.step()->pairs().empty());
  PairRule rule;
  rule.contact_distance = 0.5;
  rule.range = 9;
  apart.scene.set_rule(0, 0, rule);
  const ReportHandle report = apart.scene.step();
  REQUIRE(report->pairs().size() == count - 1);
  for (const PairReport& pair : report->pairs()) CHECK(pair.distance.upper == 8);
}

TEST_CASE("after a pose beyond 2^120 a surveyed object is found where a good one puts it") {
  Apart apart(Motion::rigid);
  for (const double height : {1.0, 2.0}) {
    for (std::size_t i = 0; i < count; ++i) apart.scene.set_pose(apart.ids[i], apart.pose(i, height));
    apart.scene.step();
  }
  Eigen::Isometry3d beyond = apart.pose(0, 0);
  beyond.translation().x() = 0x1p121;
  apart.scene.set_pose(apart.ids[0], beyond);
  CHECK(kinds_of(*apart.scene.step()) == std::vector{DiagnosticKind::too_large});
  apart.scene.set_pose(apart.ids[5], apart.pose(0, 2.25));
  CHECK(apart.scene.step()->pairs().empty());  // one of them is frozen
  const bool elsewhere = GENERATE(false, true);
  apart.scene.set_pose(apart.ids[0], apart.pose(0, elsewhere ? 2.125 : 2));
  const ReportHandle report = apart.scene.step();
  CHECK(report->diagnostics().empty());
  REQUIRE(report->pairs().size() == 1);
  CHECK(report->pairs()[0].distance.upper == (elsewhere ? 0.125 : 0.25));
}

TEST_CASE("copies are kept in the precision in which they came, and once") {
  Apart apart(Motion::deformable);
  std::vector<Eigen::Vector3f> positions(apart.mesh->vertex_count());
  ReportHandle report;
  for (int step = 0; step < 6; ++step) {
    for (std::size_t i = 0; i < count; ++i) {
      const Positions now = placed(*apart.mesh, apart.pose(i, 0.1 * step));
      std::transform(now.begin(), now.end(), positions.begin(),
                     [](const Eigen::Vector3d& p) { return p.cast<float>(); });
      apart.scene.set_positions(apart.ids[i], positions);
    }
    report = apart.scene.step();
  }
  CHECK(report->statistics().objects_surveyed == count);
  // That which was read last, that which was surveyed, and one that the next call fills.
  CHECK(report->statistics().bytes.objects < (3 * 12 + 12) * apart.vertices() + 8192);
}

TEST_CASE("unbinding copies what was told of and only surveyed") {
  Apart apart(Motion::deformable);
  std::vector<Positions> memory;
  for (std::size_t i = 0; i < count; ++i) {
    memory.push_back(placed(*apart.mesh, apart.pose(i, 1)));
    apart.scene.bind_positions(apart.ids[i], memory[i], BindPolicy::when_told);
  }
  apart.scene.step();
  for (const double height : {2.0, 3.0, 4.0}) {
    for (std::size_t i = 0; i < count; ++i) {
      const Positions now = placed(*apart.mesh, apart.pose(i, height));
      std::copy(now.begin(), now.end(), memory[i].begin());
      apart.scene.positions_changed(apart.ids[i]);
    }
    apart.scene.step();
  }
  CHECK(apart.scene.latest_report()->statistics().objects_surveyed == count);
  CHECK(apart.scene.step()->statistics().objects_surveyed == 0);
  memory[2][0].x() = std::numeric_limits<double>::infinity();
  for (const std::size_t i : {1U, 2U}) {
    apart.scene.unbind_positions(apart.ids[i]);
    memory[i] = Positions();
  }
  apart.scene.set_positions(apart.ids[0], placed(*apart.mesh, apart.pose(1, 4.25)));
  apart.scene.set_positions(apart.ids[3], placed(*apart.mesh, apart.pose(2, 4.25)));
  const ReportHandle report = apart.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
  REQUIRE(report->pairs().size() == 1);
  CHECK(report->pairs()[0].distance.upper == 0.25);
}

}  // namespace graze::tests
