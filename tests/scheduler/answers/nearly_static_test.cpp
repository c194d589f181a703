// A heap that trembles, where pairs have lists of what is near, with now and then one that jumps, a pair that
// is ignored, or another rule: every report is that of a scene built afresh.

#include <array>
#include <cmath>
#include <graze/graze.hpp>
#include <iostream>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t side = 3;
constexpr std::size_t count = side * side * 2;

/// The bodies of a heap and where they are.
class Heap {
 public:
  explicit Heap(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), now_(count) {
    for (std::size_t i = 0; i < count; ++i) place(i, 0, Eigen::Vector3d::Zero());
  }
  /// At its place but for a way off and a tremor, in numbers that floats hold.
  void place(std::size_t body, double tremor, const Eigen::Vector3d& off) {
    const std::size_t row = body / side;
    const std::size_t layer = row / side;
    const Eigen::Vector3d cell(static_cast<double>(body % side), static_cast<double>(row % side),
                               static_cast<double>(layer));
    now_[body].clear();
    for (const Eigen::Vector3d& rest : mesh_->rest()) {
      const Eigen::Vector3d by = random_.vector(-tremor, tremor);
      now_[body].push_back((1.985 * cell + rest + off + by).cast<float>().cast<double>());
    }
  }
  [[nodiscard]] const Positions& at(std::size_t body) const { return now_[body]; }
  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::vector<Positions> now_;
  oracle::Random random_{5};
};

/// A scene that is told where the bodies are in every way there is.
class Told {
 public:
  Told(const SceneSettings& settings, const Heap& heap) : scene_(settings) {
    for (std::size_t i = 0; i < count; ++i) {
      ids_.push_back(scene_.add(heap.mesh()));
      const std::size_t vertices = heap.at(i).size();
      packed_[i].resize(3 * vertices);
      gaps_[i].resize(5 * vertices);
      if (i % 4 == 0) scene_.bind_positions(ids_[i], PositionView(packed_[i].data(), vertices));
      if (i % 4 == 1)
        scene_.bind_positions(ids_[i], PositionView(gaps_[i].data(), vertices, 5 * sizeof(double)));
      if (i % 4 == 3)
        scene_.bind_positions(ids_[i], PositionView(packed_[i].data(), vertices), BindPolicy::when_told);
    }
  }
  void tell(const Heap& heap, double promise) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t v = 0; v < heap.at(i).size(); ++v)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double value = heap.at(i)[v][static_cast<Eigen::Index>(axis)];
          packed_[i][3 * v + axis] = static_cast<float>(value);
          gaps_[i][5 * v + axis] = value;
        }
      if (i % 4 == 2) scene_.set_positions(ids_[i], heap.at(i));
      if (i % 4 == 3) scene_.positions_changed(ids_[i], promise);
    }
  }
  [[nodiscard]] Scene& scene() { return scene_; }
  [[nodiscard]] ObjectId id(std::size_t body) const { return ids_[body]; }

 private:
  Scene scene_;
  std::vector<ObjectId> ids_;
  std::array<std::vector<float>, count> packed_;
  std::array<std::vector<double>, count> gaps_;
};

/// Makes the calls of a frame that both scenes get besides motion: pairs ignored and watched, and a rule.
void change(std::size_t frame, Told& told) {
  if (frame % 16 == 9) told.scene().ignore(told.id(4), told.id(13));
  if (frame % 16 == 12) told.scene().watch(told.id(4), told.id(13));
  if (frame == 20) {
    PairRule rule;
    rule.contact_distance = 0.05;
    rule.range = 0.05;
    told.scene().set_rule(0, 0, rule);
  }
}

struct Tally {
  std::uint64_t by_list = 0;
  std::uint64_t tested = 0;
  std::uint64_t surveyed_when_static = 0;
  std::size_t rows = 0;
};

void play(const SceneSettings& settings, double tremor, Tally& tally) {
  Heap heap(mesh_of(models::sphere(16, 10)));
  Told told(settings, heap);
  for (std::size_t frame = 0; frame < 30; ++frame) {
    INFO("frame " << frame << ", " << settings.threads << " threads, tremor " << tremor);
    const bool jumps = frame % 11 == 7;
    for (std::size_t i = 0; i < count; ++i)
      heap.place(i, tremor, {0, 0, jumps && i % 7 == frame % 7 ? 0.3 : 0.0});
    told.tell(heap, frame == 0 || jumps || frame % 11 == 8 ? 1 : 4 * tremor);
    change(frame, told);
    Told fresh(settings, heap);
    fresh.tell(heap, 1);
    for (std::size_t past = 0; past <= frame; ++past) change(past, fresh);
    const ReportHandle report = told.scene().step();
    const ReportHandle afresh = fresh.scene().step();
    CHECK(report->diagnostics().empty());
    const auto rows = timeless_rows_of(*report, 0.05);
    // A pair that is ignored from now on ends, which a new scene knows nothing of.
    if (frame % 16 != 9) REQUIRE(rows == timeless_rows_of(*afresh, 0.05));
    CHECK(afresh->statistics().pairs_by_list == 0);
    tally.rows += rows.size();
    tally.by_list += report->statistics().pairs_by_list;
    tally.tested += report->statistics().pairs_tested;
    if (frame % 11 == 6) tally.surveyed_when_static += report->statistics().objects_surveyed;
  }
}

}  // namespace

TEST_CASE("nearly static: in a trembling heap lists spare searches, and no report shows it") {
  for (const ContactDetail detail : {ContactDetail::features, ContactDetail::vertices})
    for (const double tremor : {1e-6, 1e-4}) {
      Tally tally;
      for (const unsigned threads : {1U, 3U}) {
        SceneSettings settings = settings_of(0.04, detail == ContactDetail::features ? 0.05 : 0.04, detail);
        settings.threads = threads;
        play(settings, tremor, tally);
      }
      CHECK(tally.rows > 1000);
      CHECK(tally.by_list * 2 > tally.tested);
      CHECK(tally.surveyed_when_static == 0);
      std::cout << tally.by_list << " of " << tally.tested << " pairs by lists, " << tally.rows << " rows\n";
    }
}

TEST_CASE("nearly static: distances of regions are current, whatever pairs are answered from") {
  Heap heap(mesh_of(models::sphere(16, 10)));
  SceneSettings settings = settings_of(0.04, 0.1);
  settings.region_distances = 100'000;
  Told told(settings, heap);
  std::uint64_t by_list = 0;
  for (std::size_t frame = 0; frame < 12; ++frame) {
    INFO("frame " << frame);
    for (std::size_t i = 0; i < count; ++i) heap.place(i, 1e-4, Eigen::Vector3d::Zero());
    told.tell(heap, frame == 0 ? 1 : 4e-4);
    Told fresh(settings, heap);
    fresh.tell(heap, 1);
    const ReportHandle report = told.scene().step();
    const ReportHandle afresh = fresh.scene().step();
    const auto found = report->region_distances();
    const auto expected = afresh->region_distances();
    REQUIRE(found.size() == expected.size());
    REQUIRE(found.size() > 300);
    for (std::size_t i = 0; i < found.size(); ++i) {
      REQUIRE(found[i].level == expected[i].level);
      REQUIRE(found[i].distance == expected[i].distance);
      REQUIRE(found[i].point_a == expected[i].point_a);
      REQUIRE(found[i].point_b == expected[i].point_b);
    }
    by_list += report->statistics().pairs_by_list;
  }
  CHECK(by_list > 200);
}

TEST_CASE("nearly static: where a box keeps still about vertices that move far, objects are surveyed") {
  Heap heap(mesh_of(models::sphere(16, 10)));
  const std::size_t vertices = heap.at(0).size();
  Scene scene(settings_of(0.04, 0.04, ContactDetail::vertices));
  std::array<std::vector<float>, 2> memory;
  for (std::size_t i = 0; i < 2; ++i) {
    memory[i].resize(3 * vertices);
    scene.bind_positions(scene.add(heap.mesh()), PositionView(memory[i].data(), vertices));
  }
  std::uint64_t surveyed = 0;
  oracle::Random random(9);
  for (std::size_t frame = 0; frame < 60; ++frame) {
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t v = 0; v < vertices; ++v) {
        // All vertices but the outermost are drawn in, by another part in every frame.
        Eigen::Vector3d point = heap.at(i)[v] - 1.985 * Eigen::Vector3d(static_cast<double>(i), 0, 0);
        if (point.cwiseAbs().maxCoeff() < 0.9) point *= random.between(0.9, 1);
        point.x() += 1.985 * static_cast<double>(i) + 1e-7 * static_cast<double>(frame % 2);
        for (std::size_t axis = 0; axis < 3; ++axis)
          memory[i][3 * v + axis] = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      }
    surveyed += scene.step()->statistics().objects_surveyed;
  }
  CHECK(surveyed > 100);
}

}  // namespace graze::tests
