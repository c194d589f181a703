// This test compares calls between two steps with a model that takes one call after the other.

#include <array>
#include <optional>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Models the calls on one deformable object: the position at which its last step saw it, and the source that
/// the next step will read.
struct Model {
  double seen = 0;
  std::optional<double> copied;
  std::optional<std::size_t> bound;

  void step(const std::array<Positions, 3>& memory) {
    if (bound) seen = memory[*bound][0].z();
    if (copied) seen = *copied;
    copied.reset();
  }
};

}  // namespace

TEST_CASE("of several calls on one object between two steps the later counts") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  oracle::Random random(7);
  Model model;
  std::array<Positions, 3> memory;
  for (int step = 0; step < 500; ++step) {
    for (std::size_t i = 0; i < memory.size(); ++i) {
      Positions now = lifted(*needle_mesh(), random.below(64));
      memory[i].resize(now.size());
      std::copy(now.begin(), now.end(), memory[i].begin());
    }
    const std::uint32_t calls = random.below(8);
    for (std::uint32_t call = 0; call < calls; ++call) {
      const std::uint32_t what = random.below(4);
      if (what == 0) {
        model.copied = random.below(64);
        model.bound.reset();
        pair.lift(*model.copied);
      } else if (what == 1) {
        model.bound = random.below(memory.size());
        model.copied.reset();
        pair.scene.bind_positions(pair.needle, memory[*model.bound]);
      } else if (what == 2) {
        if (model.bound) model.copied = memory[*model.bound][0].z();
        model.bound.reset();
        pair.scene.unbind_positions(pair.needle);
      } else {
        pair.scene.positions_changed(pair.needle);
      }
    }
    model.step(memory);
    const ReportHandle report = pair.scene.step();
    REQUIRE(report->diagnostics().empty());
    REQUIRE(only_pair(*report).witness.point_b.z() == model.seen);
  }
}

TEST_CASE("more copies than are kept for an object may wait for a step") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  for (int step = 1; step < 4; ++step) {
    for (int height = 0; height < 50; ++height) pair.lift(height + step);
    CHECK(only_pair(*pair.scene.step()).distance.upper == 49 + step);
  }
}

TEST_CASE("calls that no step took up end with their scene") {
  const auto mesh = needle_mesh();
  {
    NeedleOverPlate pair(settings_of(0.5, 100));
    pair.lift(1);
    pair.scene.step();
    for (int i = 0; i < 10; ++i) pair.lift(i);
    const ObjectId brief = pair.scene.add(mesh);
    pair.scene.set_positions(brief, mesh->rest());
    pair.scene.remove(brief);
    pair.scene.set_pose(brief, lift_pose(1));
  }
  CHECK(mesh.use_count() == 1);
}

TEST_CASE("removals among many objects leave the others, in order") {
  constexpr std::size_t count = 3000;
  Scene scene(settings_of(0.25, 0.25, ContactDetail::none));
  const auto mesh = needle_mesh();
  std::vector<ObjectId> all;
  // Objects 2k and 2k + 1 are in contact with each other and with nothing else.
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(scene.add(mesh));
    const double place = 10.0 * static_cast<double>(i / 2) + 0.125 * static_cast<double>(i % 2);
    scene.set_positions(all[i], moved(mesh->rest(), {place, 0, 0}));
  }
  CHECK(scene.step()->pairs().size() == count / 2);
  oracle::Random random(3);
  std::vector<bool> removed(count, false);
  for (int i = 0; i < 1000; ++i) {
    const std::size_t object = random.below(count);
    if (!removed[object]) scene.remove(all[object]);
    removed[object] = true;
  }
  std::vector<std::tuple<ObjectId, ObjectId, PairPhase>> expected;
  std::size_t left = 0;
  for (std::size_t i = 0; i < count; i += 2) {
    left += (removed[i] ? 0U : 1U) + (removed[i + 1] ? 0U : 1U);
    const bool ends = removed[i] || removed[i + 1];
    expected.push_back({all[i], all[i + 1], ends ? PairPhase::ended : PairPhase::touching});
  }
  const ReportHandle report = scene.step();
  std::vector<std::tuple<ObjectId, ObjectId, PairPhase>> listed;
  for (const PairReport& pair : report->pairs()) listed.emplace_back(pair.a, pair.b, pair.phase);
  CHECK(listed == expected);
  CHECK(report->statistics().objects == left);
  CHECK(report->diagnostics().empty());
}

TEST_CASE("bad input of several objects is told in the order in which they were added") {
  Scene scene(settings_of(0, 1));
  const auto mesh = needle_mesh();
  std::array<ObjectId, 5> ids;
  std::array<Positions, 5> memory;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = scene.add(mesh);
    memory[i] = lifted(*mesh, 1);
  }
  for (const std::size_t i : {3U, 0U, 4U, 2U, 1U}) scene.bind_positions(ids[i], memory[i]);
  CHECK(scene.step()->diagnostics().empty());
  for (const std::size_t i : {4U, 1U, 3U}) memory[i][0].x() = std::numeric_limits<double>::quiet_NaN();
  for (int repeat = 0; repeat < 2; ++repeat) {
    const ReportHandle report = scene.step();
    REQUIRE(kinds_of(*report) == std::vector(3, DiagnosticKind::not_finite));
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(report->diagnostics()[i].object == ids[std::array<std::size_t, 3>{1, 3, 4}[i]]);
  }
}

TEST_CASE("room made ahead of time changes nothing but where memory comes from") {
  NeedleOverPlate plain(settings_of(0.5, 10));
  NeedleOverPlate with_room(settings_of(0.5, 10));
  with_room.scene.reserve({.objects = 1000, .calls_per_step = 5000});
  for (const double height : {3.0, 0.25, 0.25, 20.0}) {
    const ReportHandle left = plain.step_at(height);
    const ReportHandle right = with_room.step_at(height);
    REQUIRE(left->pairs().size() == right->pairs().size());
    for (std::size_t i = 0; i < left->pairs().size(); ++i) {
      CHECK(left->pairs()[i].distance.upper == right->pairs()[i].distance.upper);
      CHECK(left->pairs()[i].phase == right->pairs()[i].phase);
    }
  }
  CHECK(with_room.scene.step()->diagnostics().empty());
}

}  // namespace graze::tests
