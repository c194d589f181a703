// Which pairs are looked at at all: layers and masks, motion, ignore and watch.

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {

TEST_CASE("a pair is tested when each one's layer is in the other's mask") {
  oracle::Random random(11);
  for (int round = 0; round < 20; ++round) {
    Scene scene(settings_of(0.5, 1));
    std::vector<ObjectSettings> settings(6);
    std::vector<ObjectId> ids;
    for (ObjectSettings& object : settings) {
      object.layer = 1U << random.below(3);
      if (random.chance(0.2)) object.layer |= 0x80000000U;
      object.collides_with = random.below(8) | (random.chance(0.5) ? 0x80000000U : 0U);
      ids.push_back(scene.add(plate_mesh(), object));
    }
    const ReportHandle report = scene.step();
    std::uint64_t filtered = 0;
    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = a + 1; b < ids.size(); ++b) {
        const bool allowed = (settings[a].layer & settings[b].collides_with) != 0 &&
                             (settings[b].layer & settings[a].collides_with) != 0;
        CHECK((find_pair(*report, ids[a], ids[b]) != nullptr) == allowed);
        filtered += allowed ? 0U : 1U;
      }
    CHECK(report->statistics().pairs_filtered == filtered);
  }
}

TEST_CASE("pairs of fixed objects are never tested") {
  Scene scene(settings_of(0.5, 1));
  std::vector<ObjectId> ids;
  std::vector<Motion> motions;
  for (const Motion motion : {Motion::fixed, Motion::rigid, Motion::deformable, Motion::fixed}) {
    ids.push_back(scene.add(plate_mesh(), motion_of(motion)));
    motions.push_back(motion);
  }
  const ReportHandle report = scene.step();
  for (std::size_t a = 0; a < ids.size(); ++a)
    for (std::size_t b = a + 1; b < ids.size(); ++b)
      CHECK((find_pair(*report, ids[a], ids[b]) == nullptr) ==
            (motions[a] == Motion::fixed && motions[b] == Motion::fixed));
  scene.watch(ids[0], ids[3]);
  CHECK(find_pair(*scene.step(), ids[0], ids[3]) == nullptr);
}

TEST_CASE("a pair ignored while in contact ends once, and begins again when it is watched") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  pair.step_at(0.25);
  pair.scene.ignore(pair.needle, pair.plate);  // in either order
  const ReportHandle ended = pair.step_at(0.125);
  CHECK(only_pair(*ended).phase == PairPhase::ended);
  CHECK(only_pair(*ended).distance.lower == 0.125);
  CHECK(only_pair(*ended).distance.upper == 0.125);
  CHECK(only_pair(*ended).witness.point_b == Eigen::Vector3d(0.25, 0.5, 0.125));
  CHECK_FALSE(only_pair(*ended).stale);
  CHECK(only_pair(*ended).complete);
  CHECK(ended->contacts().empty());
  CHECK(pair.scene.step()->pairs().empty());
  CHECK(pair.scene.step()->pairs().empty());
  pair.scene.watch(pair.plate, pair.needle);
  const ReportHandle again = pair.scene.step();
  CHECK(only_pair(*again).phase == PairPhase::began);
  CHECK(again->contacts().size() == 1);
}

TEST_CASE("a pair that pierces ends with distance 0 when it is ignored") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate pair(settings_of(0, 1, detail));
    CHECK(only_pair(*pair.step_at(-1)).phase == PairPhase::began);
    pair.scene.ignore(pair.needle, pair.plate);
    const ReportHandle ended = pair.scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(only_pair(*ended).distance.upper == 0);
    CHECK(ended->contacts().empty());
    CHECK(pair.scene.step()->pairs().empty());
  }
}

TEST_CASE("an ignored pair that parts in the same step ends with the distance of now") {
  for (const ContactDetail detail : all_details) {
    Scene scene(settings_of(0.5, 1, detail));
    const ObjectId low = scene.add(plate_mesh());
    const ObjectId high = scene.add(plate_mesh());
    CHECK(only_pair(*scene.step()).phase == PairPhase::began);
    scene.set_positions(high, lifted(*plate_mesh(), 64));
    scene.ignore(low, high);
    const ReportHandle ended = scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(only_pair(*ended).distance.lower == 64);
    CHECK(only_pair(*ended).distance.upper == 64);
    CHECK(scene.step()->pairs().empty());
  }
}

TEST_CASE("a near pair that is ignored is gone at once") {
  NeedleOverPlate pair(settings_of(0.5, 4));
  CHECK(only_pair(*pair.step_at(2)).phase == PairPhase::near);
  pair.scene.ignore(pair.plate, pair.needle);
  CHECK(pair.scene.step()->pairs().empty());
  pair.scene.watch(pair.plate, pair.needle);
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::near);
}

TEST_CASE("of ignore and watch between two steps the last counts") {
  NeedleOverPlate pair(settings_of(0.5, 4));
  pair.step_at(0.25);
  pair.scene.ignore(pair.plate, pair.needle);
  pair.scene.watch(pair.needle, pair.plate);
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::touching);
  pair.scene.watch(pair.plate, pair.needle);
  pair.scene.ignore(pair.plate, pair.needle);
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::ended);
}

TEST_CASE("only the ignored pair is taken out") {
  Scene scene(settings_of(0.5, 1));
  std::vector<ObjectId> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(scene.add(plate_mesh()));
  scene.ignore(ids[1], ids[2]);
  const ReportHandle report = scene.step();
  CHECK(report->pairs().size() == 5);
  CHECK(find_pair(*report, ids[1], ids[2]) == nullptr);
  CHECK(inconsistency_of(*report) == "");
}

}  // namespace graze::tests
