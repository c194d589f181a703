// Replays that begin amid a recording, and parts that were cut out by frames or by objects: nothing has
// diverged in them, whatever the accuracy and the limits. What they must have in common with the recorded
// answers is still compared.

#include <algorithm>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <limits>
#include <optional>
#include <random>

#include "core/pair/pair_query.hpp"
#include "models/models.hpp"
#include "replay/row_comparison.hpp"
#include "scheduler/random_calls.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t recorded_frames = 32;

/// What a replay of a whole file has found.
struct Findings {
  std::string first_difference;
  std::size_t not_compared = 0;
  std::size_t in_part = 0;
};

Findings findings_of(const std::filesystem::path& file, std::size_t first_frame = 0) {
  const Recording recording(file);
  Replay replay(recording, {.threads = 1, .first_frame = first_frame});
  Findings found;
  while (replay.step()) {
    found.not_compared += replay.rows_not_compared();
    found.in_part += replay.rows_compared_in_part();
    const auto& difference = replay.difference();
    if (difference && found.first_difference.empty())
      found.first_difference = "frame " + std::to_string(difference->frame) + ", " + difference->pair +
                               "\n  recorded " + difference->recorded + "\n  replayed " +
                               difference->replayed;
  }
  return found;
}

RecorderSettings never_dropping() {
  return {.keyframe_interval = 8, .waiting_frames = 1000};
}

/// Records balls and boxes that jostle each other.
void record_crowd(const SceneSettings& settings, const std::filesystem::path& file, unsigned seed) {
  const auto ball = mesh_of(models::sphere(12, 6));
  const auto box = mesh_of(models::box({1.8, 1.8, 1.8}));
  Scene scene(settings);
  Recorder recorder(scene, file, never_dropping());
  std::mt19937 random(seed);
  std::normal_distribution<double> jolt(0, 0.04);
  std::vector<ObjectId> ids;
  std::vector<Eigen::Vector3d> places;
  for (int body = 0; body < 8; ++body) {
    ids.push_back(scene.add(body % 2 == 0 ? ball : box, motion_of(Motion::rigid)));
    places.emplace_back(2.15 * (body % 3), 2.15 * (body / 3), 0);
  }
  for (std::size_t frame = 0; frame < recorded_frames; ++frame) {
    for (std::size_t body = 0; body < ids.size(); ++body) {
      places[body] += Eigen::Vector3d{jolt(random), jolt(random), jolt(random)};
      if (random() % 4 > 0) scene.set_pose(ids[body], Eigen::Isometry3d(Eigen::Translation3d(places[body])));
    }
    (void)scene.step();
  }
  recorder.close();
}

/// Records random calls, many of them wrong: frozen objects, replaced meshes, rules and ignored pairs.
void record_calls(const SceneSettings& settings, const std::filesystem::path& file, unsigned seed) {
  Scene scene(settings);
  Recorder recorder(scene, file, never_dropping());
  RandomCalls calls(seed);
  for (std::size_t frame = 0; frame < recorded_frames; ++frame) {
    calls.make(scene);
    (void)scene.step();
  }
  recorder.close();
}

/// Every way in which an answer may depend on the steps before or on the other pairs.
std::vector<std::pair<std::string, SceneSettings>> dependent_settings(ContactDetail detail) {
  std::vector<std::pair<std::string, SceneSettings>> all;
  const auto add = [&](const std::string& name, const auto& change) {
    SceneSettings settings = settings_of(0.125, 1, detail);
    settings.threads = 1;
    change(settings);
    all.emplace_back(name, settings);
  };
  add("exact", [](SceneSettings&) {});
  add("within", [](SceneSettings& settings) { settings.accuracy = Accuracy::within(0.5); });
  add("work_budget", [](SceneSettings& settings) { settings.work_budget = 60; });
  add("max_contacts", [](SceneSettings& settings) { settings.max_contacts = 20; });
  add("max_contacts_per_pair", [](SceneSettings& settings) { settings.max_contacts_per_pair = 5; });
  add("carrying", [](SceneSettings& settings) { settings.carrying = 3; });
  add("region_distances", [](SceneSettings& settings) { settings.region_distances = 40; });
  add("time_budget", [](SceneSettings& settings) { settings.time_budget = std::chrono::microseconds(30); });
  add("all", [](SceneSettings& settings) {
    settings.accuracy = Accuracy::within(0.5);
    settings.work_budget = 60;
    settings.max_contacts = 20;
    settings.max_contacts_per_pair = 5;
    settings.carrying = 4;
    settings.region_distances = 40;
  });
  if (is_about_vertices(detail))
    add("paper", [](SceneSettings& settings) { settings.accuracy = Accuracy::paper({0.25, 0.125}); });
  return all;
}

/// Replays parts of a recording. Returns how many rows they compared in part.
std::size_t check_parts(const std::filesystem::path& file, const std::filesystem::path& part,
                        bool has_clock) {
  const Findings whole = findings_of(file);
  CHECK(whole.first_difference == "");
  if (!has_clock) CHECK(whole.not_compared + whole.in_part == 0);
  std::size_t in_part = 0;
  const auto check = [&](const Findings& found) {
    CHECK(found.first_difference == "");
    in_part += found.in_part;
  };
  for (const std::size_t first : {7U, 16U, 23U}) {
    INFO("from frame " << first);
    check(findings_of(file, first));
  }
  const Recording recording(file);
  for (const RecordingPart& wanted :
       {RecordingPart{10, 27, {}}, RecordingPart{0, 31, {0, 1}}, RecordingPart{12, 27, {1, 2}}}) {
    INFO("cut from frame " << wanted.first_frame << ", " << wanted.objects.size() << " objects");
    cut_recording(recording, wanted, part);
    check(findings_of(part));
  }
  return in_part;
}

/// A row of a pair that is apart, with bounds.
RecordedRow near_row(double lower, double upper, std::uint64_t answer) {
  RecordedRow row;
  row.lower = lower;
  row.upper = upper;
  row.answer_hash = answer;
  return row;
}

RecordedRow touching_row(std::uint64_t contacts, bool is_cut, std::uint64_t answer) {
  RecordedRow row = near_row(0.1, 0.1, answer);
  row.phase = PairPhase::touching;
  row.contacts = contacts;
  row.contacts_cut = is_cut;
  row.complete = !is_cut;
  return row;
}

/// What a replay that does not know the history says of two rows of a pair whose range is 1.
RowVerdict verdict_of(const SceneSettings& settings, const RecordedRow* recorded,
                      const RecordedRow* replayed) {
  return RowComparison(settings, false).compare(recorded, replayed, 1);
}
RowVerdict verdict_of(const SceneSettings& settings, const RecordedRow& recorded,
                      const RecordedRow& replayed) {
  return verdict_of(settings, &recorded, &replayed);
}

}  // namespace

TEST_CASE("recording parts: nothing diverges, whatever accuracy and limits") {
  const TemporaryFolder folder;
  for (const ContactDetail detail :
       {ContactDetail::none, ContactDetail::closest, ContactDetail::regions, ContactDetail::vertices,
        ContactDetail::features, ContactDetail::nearest}) {
    if (!at_full_effort && detail != ContactDetail::regions && detail != ContactDetail::nearest) continue;
    for (const auto& [name, settings] : dependent_settings(detail)) {
      INFO("detail " << static_cast<int>(detail) << ", " << name);
      const bool has_clock = settings.time_budget.has_value();
      record_crowd(settings, folder / "run.graze", 3);
      std::size_t in_part = check_parts(folder / "run.graze", folder / "part.graze", has_clock);
      for (unsigned seed = 0; seed < 2; ++seed) {
        INFO("random calls, seed " << seed);
        record_calls(settings, folder / "run.graze", seed);
        in_part += check_parts(folder / "run.graze", folder / "part.graze", has_clock);
      }
      // Every row is compared bit for bit where it depends on no other step and pair.
      if (name == "exact" || name == "max_contacts_per_pair" || name == "paper") CHECK(in_part == 0);
      if (name == "region_distances" || name == "all") CHECK(in_part > 0);
      if (name == "carrying" && detail != ContactDetail::nearest) CHECK(in_part == 0);
    }
  }
}

TEST_CASE("recording parts: contacts that carry follow from those listed before, and are compared in part") {
  const TemporaryFolder folder;
  SceneSettings settings = settings_of(0.125, 1, ContactDetail::nearest);
  settings.threads = 1;
  settings.carrying = 1;
  std::size_t in_part = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    INFO("seed " << seed);
    record_crowd(settings, folder / "run.graze", seed);
    in_part += check_parts(folder / "run.graze", folder / "part.graze", false);
  }
  CHECK(in_part > 0);
}

TEST_CASE("recording parts: an object that was frozen before a keyframe is frozen in a part after it") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "run.graze";
  SceneSettings settings = settings_of(0.5, 2);
  settings.threads = 1;
  for (const bool is_frozen_before : {false, true}) {
    NeedleOverPlate stage(settings);
    Positions memory = lifted(*needle_mesh(), 0.25);
    std::optional<Recorder> recorder;
    if (!is_frozen_before) recorder.emplace(stage.scene, file, never_dropping());
    // The needle is frozen by bad memory, and stays so without it: no pair of it is looked at.
    memory[0].x() = std::numeric_limits<double>::quiet_NaN();
    stage.scene.bind_positions(stage.needle, memory);
    (void)stage.scene.step();
    stage.scene.unbind_positions(stage.needle);
    (void)stage.scene.step();
    if (is_frozen_before) recorder.emplace(stage.scene, file, never_dropping());
    for (int frame = 0; frame < 30; ++frame) (void)stage.scene.step();
    recorder->close();
    // The part begins some frames after a keyframe, which its model of the scene is made from.
    cut_recording(Recording(file), {.first_frame = 19}, folder / "part.graze");
    const Findings found = findings_of(folder / "part.graze");
    CHECK(found.first_difference == "");
    CHECK(found.not_compared == 0);
  }
}

TEST_CASE(
    "recording parts: memory that was told of before a keyframe, and read after it, is read in a part") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "run.graze";
  SceneSettings settings = settings_of(0.5, 2);
  settings.threads = 1;
  NeedleOverPlate stage(settings);
  Positions memory = lifted(*needle_mesh(), 50);
  Recorder recorder(stage.scene, file, never_dropping());
  stage.scene.bind_positions(stage.needle, memory, BindPolicy::when_told);
  for (std::size_t frame = 0; frame < 24; ++frame) {
    if (frame < 8) {  // far from the plate, so that the promise keeps the needle unread
      const Positions now = lifted(*needle_mesh(), 50 - 0.125 * static_cast<double>(frame));
      std::copy(now.begin(), now.end(), memory.begin());
      stage.scene.positions_changed(stage.needle, 0.25);
    }
    if (frame == 13) stage.scene.set_positions(stage.plate, lifted(*plate_mesh(), 48.875));
    CHECK((*stage.scene.step()).pairs().size() == (frame < 13 ? 0U : 1U));
  }
  recorder.close();
  for (const std::size_t first : {8U, 12U}) CHECK(findings_of(file, first).first_difference == "");
  cut_recording(Recording(file), {.first_frame = 10}, folder / "part.graze");
  CHECK(findings_of(folder / "part.graze").first_difference == "");
}

TEST_CASE("recording parts: what must hold is compared, and the rest is counted") {
  const SceneSettings exact = settings_of(0.125, 1);
  SceneSettings within = exact;
  within.accuracy = Accuracy::within(0.5);
  SceneSettings limited = exact;
  limited.max_contacts = 20;
  SceneSettings regions = exact;
  regions.region_distances = 40;
  SceneSettings carrying = exact;
  carrying.detail = ContactDetail::nearest;
  carrying.carrying = 8;

  CHECK(verdict_of(exact, near_row(0.5, 0.5, 1), near_row(0.5, 0.5, 1)) == RowVerdict::same);
  CHECK(verdict_of(exact, near_row(0.5, 0.5, 1), near_row(0.5, 0.5, 2)) == RowVerdict::differs);
  CHECK(verdict_of(regions, near_row(0.5, 0.5, 1), near_row(0.5, 0.5, 2)) == RowVerdict::holds);
  CHECK(verdict_of(regions, near_row(0.5, 0.5, 1), near_row(0.5, 0.75, 2)) == RowVerdict::differs);
  CHECK(verdict_of(within, near_row(0.5, 0.75, 1), near_row(0.6, 0.9, 2)) == RowVerdict::holds);
  CHECK(verdict_of(within, near_row(0.5, 0.75, 1), near_row(0.8, 0.9, 2)) == RowVerdict::differs);
  CHECK(verdict_of(within, near_row(0.5, 0.75, 1), touching_row(3, false, 2)) == RowVerdict::differs);
  CHECK(verdict_of(within, touching_row(3, false, 1), touching_row(3, false, 2)) == RowVerdict::differs);

  CHECK(verdict_of(limited, touching_row(9, true, 1), touching_row(9, true, 1)) == RowVerdict::same);
  CHECK(verdict_of(limited, touching_row(9, true, 1), touching_row(12, false, 2)) == RowVerdict::holds);
  CHECK(verdict_of(limited, touching_row(9, true, 1), touching_row(9, true, 2)) == RowVerdict::differs);
  CHECK(verdict_of(limited, touching_row(9, false, 1), touching_row(12, false, 2)) == RowVerdict::differs);
  CHECK(verdict_of(exact, touching_row(9, true, 1), touching_row(12, false, 2)) == RowVerdict::differs);

  CHECK(verdict_of(carrying, touching_row(8, false, 1), touching_row(8, false, 1)) == RowVerdict::same);
  CHECK(verdict_of(carrying, touching_row(8, false, 1), touching_row(6, false, 2)) == RowVerdict::holds);
  CHECK(verdict_of(carrying, touching_row(8, false, 1), touching_row(0, false, 2)) == RowVerdict::differs);
  CHECK(verdict_of(carrying, touching_row(8, false, 1), near_row(0.1, 0.1, 2)) == RowVerdict::differs);
  RecordedRow nearer = touching_row(8, false, 2);
  nearer.lower = nearer.upper = 0.05;
  CHECK(verdict_of(carrying, touching_row(8, false, 1), nearer) == RowVerdict::differs);
  carrying.detail = ContactDetail::features;
  CHECK(verdict_of(carrying, touching_row(8, false, 1), touching_row(8, false, 2)) == RowVerdict::differs);

  RecordedRow cut_short = near_row(0, 0.4, 1);
  cut_short.complete = false;
  CHECK(verdict_of(exact, cut_short, touching_row(9, false, 2)) == RowVerdict::holds);
  CHECK(verdict_of(exact, near_row(0.5, 0.5, 2), cut_short) == RowVerdict::differs);
}

TEST_CASE("recording parts: a row that only one report has must have a reason") {
  const SceneSettings exact = settings_of(0.125, 1);
  SceneSettings within = exact;
  within.accuracy = Accuracy::within(0.5);
  const RecordedRow near = near_row(0.5, 0.5, 1);
  const RecordedRow maybe_near = near_row(0.9, 1.2, 1);
  RecordedRow ended = near;
  ended.phase = PairPhase::ended;
  RecordedRow cut_short = maybe_near;
  cut_short.complete = false;
  CHECK(verdict_of(exact, &near, nullptr) == RowVerdict::differs);
  CHECK(verdict_of(exact, nullptr, &near) == RowVerdict::differs);
  CHECK(verdict_of(exact, &maybe_near, nullptr) == RowVerdict::differs);
  CHECK(verdict_of(within, &near, nullptr) == RowVerdict::differs);
  CHECK(verdict_of(within, &maybe_near, nullptr) == RowVerdict::not_compared);
  CHECK(verdict_of(exact, nullptr, &cut_short) == RowVerdict::not_compared);
  CHECK(verdict_of(exact, nullptr, &ended) == RowVerdict::not_compared);
  CHECK(verdict_of(exact, &ended, nullptr) == RowVerdict::not_compared);
  CHECK(RowComparison(exact, true).compare(&ended, nullptr, 1) == RowVerdict::differs);
}

}  // namespace graze::tests
