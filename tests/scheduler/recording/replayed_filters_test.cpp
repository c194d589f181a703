// A replay knows what had been said of pairs: which are ignored, and the thresholds of kinds.

#include <filesystem>
#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t frames = 20;

/// Everything that filters say, as lines with serials of objects in place of ids.
using Lines = std::set<std::string>;

std::string both(const std::string& a, const std::string& b) {
  return a < b ? a + " " + b : b + " " + a;
}
std::string group_line(std::uint64_t a, unsigned group_a, std::uint64_t b, unsigned group_b) {
  return "groups " + both(std::to_string(a) + "/" + std::to_string(group_a),
                          std::to_string(b) + "/" + std::to_string(group_b));
}
std::string pair_line(std::uint64_t a, std::uint64_t b) {
  return "pair " + both(std::to_string(a), std::to_string(b));
}
std::string rule_line(unsigned kind_a, unsigned kind_b, double contact_distance) {
  return "rule " + both(std::to_string(kind_a), std::to_string(kind_b)) + " " +
         std::to_string(contact_distance);
}

/// Records a scene of four plates. Returns what counted in each frame.
std::vector<Lines> record(const std::filesystem::path& file) {
  Scene scene(settings_of(0.05, 0.2));
  std::vector<ObjectId> plates;
  for (int i = 0; i < 4; ++i) {
    ObjectSettings settings;
    settings.motion = Motion::rigid;
    settings.kind = 1;
    settings.face_groups = {static_cast<std::uint8_t>(i)};
    plates.push_back(scene.add(plate_mesh(), settings));
  }
  Recorder recorder(scene, file, {.keyframe_interval = 4, .waiting_frames = 1000});
  std::vector<Lines> said;
  Lines now;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (frame == 1) {
      scene.ignore(plates[2], plates[0]);
      scene.ignore(plates[3], 3, plates[1], 1);
      scene.set_rule(2, 1, {.contact_distance = 0.5});
      now = {pair_line(0, 2), group_line(1, 1, 3, 3), rule_line(1, 2, 0.5)};
    }
    if (frame == 6) {
      scene.watch(plates[0], plates[2]);
      scene.ignore(plates[0], plates[3]);
      scene.set_rule(1, 2, {.contact_distance = 0.25});
      now = {pair_line(0, 3), group_line(1, 1, 3, 3), rule_line(1, 2, 0.25)};
    }
    if (frame == 11) scene.remove(plates[3]);
    if (frame == 11) now = {rule_line(1, 2, 0.25)};
    if (frame == 15) scene.set_rule(1, 2, {});
    if (frame == 15) now.clear();
    scene.step();
    said.push_back(now);
  }
  recorder.close();
  return said;
}

Lines lines_of(const PairFilters& filters, const Replay& replay) {
  std::map<ObjectId, std::uint64_t> serials;
  for (const ReplayObject& object : replay.objects()) serials[object.id] = object.serial;
  Lines lines;
  for (const auto& [a, b] : filters.ignored) lines.insert(pair_line(serials.at(a), serials.at(b)));
  for (const auto& [a, b] : filters.ignored_groups)
    lines.insert(group_line(serials.at(a.object), a.group, serials.at(b.object), b.group));
  for (const auto& rule : filters.rules)
    lines.insert(rule_line(rule.kind_a, rule.kind_b, rule.rule.contact_distance.value()));
  return lines;
}

}  // namespace

TEST_CASE("recording: a replay knows rules and ignored pairs of each frame, wherever it begins") {
  const TemporaryFolder folder;
  const std::vector<Lines> said = record(folder / "run.graze");
  const Recording recording(folder / "run.graze");
  for (const std::size_t first : {0U, 3U, 9U, 13U}) {
    Replay replay(recording, {.threads = 1, .first_frame = first});
    std::shared_ptr<const PairFilters> last;
    while (replay.step()) {
      const std::size_t frame = replay.frame_index();
      INFO("begun at " << first << ", frame " << frame);
      CHECK(lines_of(*replay.pair_filters(), replay) == said[frame]);
      if (last) CHECK((replay.pair_filters() == last) == (said[frame] == said[frame - 1]));
      last = replay.pair_filters();
    }
    CHECK(replay.frame_index() + 1 == frames);
  }
}

TEST_CASE("recording: an object of a replay has the groups of its mesh now") {
  const TemporaryFolder folder;
  {
    Scene scene(settings_of(0.05, 0.2));
    ObjectSettings settings;
    settings.face_groups = {5};
    const ObjectId plate = scene.add(plate_mesh(), settings);
    Recorder recorder(scene, folder / "run.graze", {.waiting_frames = 1000});
    scene.step();
    const auto two = std::make_shared<const Mesh>(Mesh::from_quads(
        std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
        std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {1, 4, 5, 2}}));
    scene.replace_mesh(plate, two, std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint8_t>{6, 7});
    scene.step();
    recorder.close();
  }
  const Recording recording(folder / "run.graze");
  Replay replay(recording);
  REQUIRE(replay.step());
  CHECK(replay.objects()[0].settings.face_groups == std::vector<std::uint8_t>{5});
  REQUIRE(replay.step());
  CHECK(replay.objects()[0].settings.face_groups == std::vector<std::uint8_t>{6, 7});
}

}  // namespace graze::tests
