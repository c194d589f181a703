// Recordings are replayed: with other numbers of threads, from the middle, cut, damaged, and with frames
// that were dropped. The oracle is the report of the recorded step itself, and the recorder's own hashes.

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <graze/instruction_set.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <set>

#include "recording/chunks.hpp"
#include "recording/crc32.hpp"
#include "scenes/played_scene.hpp"
#include "scheduler/moving_scene.hpp"
#include "scheduler/random_calls.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

/// A file that is gone at the end of the test.
class TemporaryFile {
 public:
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "run.graze"; }
  [[nodiscard]] std::string bytes() const {
    std::ifstream in(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const { (void)folder_.write("run.graze", bytes); }

 private:
  TemporaryFolder folder_;
};

/// A recorder that drops nothing, however slow the machine is.
RecorderSettings patient(std::uint32_t keyframe_interval = 7) {
  return {.keyframe_interval = keyframe_interval, .waiting_frames = 1000};
}

/// The message of an error, or nothing.
template <typename Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Replays all frames and returns the first difference as text.
std::string first_difference(const std::filesystem::path& file, const ReplaySettings& settings = {}) {
  const Recording recording(file);
  Replay replay(recording, settings);
  while (replay.step())
    if (const auto& difference = replay.difference())
      return "frame " + std::to_string(difference->frame) + ", " + difference->pair + "\n  recorded " +
             difference->recorded + "\n  replayed " + difference->replayed;
  return "";
}

oneapi::tbb::global_control allow(unsigned threads) {
  return {oneapi::tbb::global_control::max_allowed_parallelism, threads};
}

/// Everything that a report says but for counters, times and ids, which a replay may give in another order.
std::string whole_text(const FrameReport& report) {
  std::string text;
  for (const std::string& row : rows_of(report)) {
    const std::size_t after_a = row.find(' ');
    text += row.substr(row.find(' ', after_a + 1)) + "\n";
  }
  for (const Diagnostic& diagnostic : report.diagnostics())
    text += std::string(to_string(diagnostic.kind)) + "\n";
  return text;
}

/// Every detail in turn, and with each of them other limits from turn to turn.
SceneSettings random_settings(unsigned seed) {
  const auto details = static_cast<unsigned>(all_details.size());
  SceneSettings settings = settings_of(0.25, 1, all_details[seed % details]);
  settings.threads = 1;
  const unsigned turn = seed / details;
  if (turn % 3 == 0) settings.max_contacts_per_pair = 2;
  if (turn % 3 == 1) settings.max_contacts = 5;
  if (turn % 3 == 2) settings.carrying = 3;
  if (turn % 4 == 0) settings.region_distances = 64;
  return settings;
}

/// Records random calls and keeps what each report says.
std::vector<std::string> record_random_calls(unsigned seed, std::size_t frames, std::size_t before,
                                             const std::filesystem::path& file,
                                             const SceneSettings& settings) {
  Scene scene(settings);
  RandomCalls calls(seed);
  for (std::size_t frame = 0; frame < before; ++frame) {
    calls.make(scene);
    (void)scene.step();
  }
  Recorder recorder(scene, file, patient());
  std::vector<std::string> texts;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    calls.make(scene);
    const ReportHandle report = scene.step(frame);
    texts.push_back(whole_text(*report));
  }
  recorder.close();
  CHECK(recorder.statistics().frames == frames);
  CHECK(recorder.statistics().dropped == 0);
  return texts;
}

/// The bytes of a recording of three frames, with two keyframes.
std::string three_frames() {
  const TemporaryFile file;
  NeedleOverPlate stage(settings_of(0.5, 100));
  Recorder recorder(stage.scene, file.path(), patient(2));
  for (const double height : {0.75, 0.25, 0.125}) stage.step_at(height);
  recorder.close();
  return file.bytes();
}

/// The recording without an index, and with another upper bound and hash in the row of its second frame.
std::string with_wrong_answer(const std::string& recording) {
  ByteBuffer all;
  all.append(std::as_bytes(std::span(recording)));
  ByteBuffer changed;
  changed.append(all.bytes().first(FileHead::size));
  for (std::size_t at = FileHead::size;;) {
    ChunkHead head;
    REQUIRE(read_checked(all.bytes().subspan(at, ChunkHead::size), head));
    if (head.kind == ChunkKind::index) break;
    const std::size_t size = ChunkHead::size + static_cast<std::size_t>(head.payload_size);
    if (head.kind == ChunkKind::step && head.number == 2) {
      ByteBuffer payload;
      payload.append(all.bytes().subspan(at + ChunkHead::size, size - ChunkHead::size));
      ByteSource source(payload.bytes());
      StepHead step;
      source(step);
      source.align();
      step.report.rows.at(0).upper = 0.5;
      step.report.rows.at(0).answer_hash ^= 1;
      step.hash = hash_of(step.report);
      ByteBuffer chunk;
      chunk.grow(ChunkHead::size);
      write_fields(chunk, step);
      append_records(chunk, payload.bytes().subspan(source.at()));
      seal_chunk(chunk, ChunkKind::step, 2);
      changed.append(chunk.bytes());
    } else {
      changed.append(all.bytes().subspan(at, size));
    }
    at += size;
  }
  return {reinterpret_cast<const char*>(changed.bytes().data()), changed.size()};
}

}  // namespace

TEST_CASE("recording: the checksum is the CRC-32 that zlib has") {
  const auto of = [](std::string_view text) { return crc32(std::as_bytes(std::span(text))); };
  CHECK(of("") == 0);
  CHECK(of("123456789") == 0xCBF43926U);
  CHECK(of("The quick brown fox jumps over the lazy dog") == 0x414FA339U);
}

TEST_CASE("recording: scenes are answered again, by any number of threads and instruction set") {
  const auto allowed = allow(8);
  const InstructionSet before = instruction_set();
  for (const std::string_view name : scenes::played_scene_names()) {
    const TemporaryFile file;
    {
      const auto played = scenes::make_played_scene(name);
      SceneSettings settings = played->settings();
      settings.threads = 2;
      Scene scene(settings);
      Recorder recorder(scene, file.path(), patient());
      for (std::size_t frame = 0; frame < 12; ++frame) {
        played->advance(scene, frame);
        (void)scene.step();
      }
      recorder.close();
      CHECK(recorder.statistics().frames == 12);
    }
    for (const unsigned threads : {8U, 1U, 2U}) {
      if (!at_full_effort && threads != 8) continue;
      INFO(name << ", " << threads << " threads");
      CHECK(first_difference(file.path(), {.threads = threads}) == "");
    }
    use_instruction_set(InstructionSet::scalar);
    CHECK(first_difference(file.path()) == "");
    use_instruction_set(before);
  }
}

TEST_CASE("recording: random calls, many of them wrong, are answered again with all diagnostics") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    INFO("seed " << seed);
    const TemporaryFile file;
    const std::vector<std::string> texts =
        record_random_calls(seed, 40, 0, file.path(), random_settings(seed));
    CHECK(first_difference(file.path()) == "");
    const Recording recording(file.path());
    CHECK(recording.is_finished());
    CHECK_FALSE(recording.is_cut());
    REQUIRE(recording.frame_count() == texts.size());
    Replay replay(recording);
    std::size_t diagnostics = 0;
    for (std::size_t frame = 0; replay.step(); ++frame) {
      CHECK(recording.frame(frame).tag == frame);
      CHECK(recording.frame(frame).contacts == replay.report()->contacts().size());
      CHECK(whole_text(*replay.report()) == texts[frame]);
      diagnostics += replay.report()->diagnostics().size();
    }
    CHECK(diagnostics > 0);
  }
}

TEST_CASE("recording: a replay begins at any frame, and a recording in the middle of a run") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    const TemporaryFile whole;
    (void)record_random_calls(seed, 30, 0, whole.path(), random_settings(seed));
    for (std::size_t first = 0; first < 30; first += 4)
      CHECK(first_difference(whole.path(), {.first_frame = first}) == "");
    const TemporaryFile late;
    (void)record_random_calls(seed, 30, 10, late.path(), random_settings(seed));
    CHECK(Recording(late.path()).is_cut());
    CHECK(first_difference(late.path()) == "");
  }
}

TEST_CASE("recording: a part has the same answers, of all objects or of two") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    const TemporaryFile whole;
    const TemporaryFile part;
    (void)record_random_calls(seed, 30, 0, whole.path(), random_settings(seed));
    const Recording recording(whole.path());
    cut_recording(recording, {.first_frame = 11, .last_frame = 17}, part.path());
    CHECK(Recording(part.path()).frame_count() == 7);
    CHECK(Recording(part.path()).is_cut());
    CHECK(first_difference(part.path()) == "");
    cut_recording(recording, {.first_frame = 9, .last_frame = 20, .objects = {0, 2}}, part.path());
    CHECK(first_difference(part.path()) == "");
    CHECK(message_of([&] { cut_recording(recording, {.first_frame = 30}, part.path()); }) ==
          "the part has no frame: the recording has 30 frames, and the part would be from index 30 on");
  }
}

TEST_CASE("recording: any flipped bit is found by a check and by a replay, and the place is named") {
  const std::string good = three_frames();
  const TemporaryFile damaged;
  std::size_t unnamed = 0;
  for (std::size_t byte = 0; byte < good.size(); ++byte) {
    std::string bad = good;
    bad[byte] = static_cast<char>(bad[byte] ^ 1 << byte % 8);
    damaged.write(bad);
    const std::string message = message_of([&] { Recording(damaged.path()).check(); });
    const std::string of_replay = message_of([&] { (void)first_difference(damaged.path()); });
    INFO("byte " << byte << " of " << good.size() << ": " << message << ", replay: " << of_replay);
    CHECK(message != "");
    CHECK(of_replay != "");
    for (const std::string& told : {message, of_replay})
      if (told.find(": byte ") == std::string::npos) ++unnamed;
  }
  CHECK(unnamed == 0);
}

TEST_CASE("recording: a file that was not finished is read up to its last whole frame") {
  const TemporaryFile file;
  const std::string good = three_frames();
  std::set<std::size_t> counts;
  for (std::size_t size = 0; size < good.size(); size += 3) {
    file.write(good.substr(0, size));
    const std::string message = message_of([&] {
      const Recording recording(file.path());
      CHECK_FALSE(recording.is_finished());
      counts.insert(recording.frame_count());
      if (recording.frame_count() == 0) return;
      CHECK(first_difference(file.path()) == "");
    });
    INFO(size << " of " << good.size() << " bytes: " << message);
    CHECK((message == "" || size < 400));
  }
  CHECK(counts == std::set<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("recording: what is no recording, or of another version, is refused by name") {
  const TemporaryFile file;
  file.write("no recording at all, but long enough to be read");
  CHECK(message_of([&] { Recording recording(file.path()); }) ==
        file.path().string() + ": byte 0: this is no recording of graze");
  CHECK(message_of([&] { Recording recording("/no/such/file"); }).find("cannot be opened") !=
        std::string::npos);
}

TEST_CASE("recording: a changed answer is told with frame, pair and both rows") {
  const TemporaryFile file;
  {
    SceneSettings settings = settings_of(0.5, 100);
    settings.threads = 1;
    NeedleOverPlate stage(settings, {.name = "plate"}, {.name = "needle"});
    Recorder recorder(stage.scene, file.path(), patient());
    for (const double height : {0.75, 0.25}) stage.step_at(height);
    recorder.close();
  }
  CHECK(first_difference(file.path()) == "");
  // A wrong build is played by a recording with a wrong answer, whose checksums are right.
  file.write(with_wrong_answer(file.bytes()));
  const Recording recording(file.path());
  Replay replay(recording);
  REQUIRE(replay.step());
  CHECK_FALSE(replay.difference());
  REQUIRE(replay.step());
  REQUIRE(replay.difference());
  CHECK(replay.difference()->frame == 2);
  CHECK(replay.difference()->pair == "\"plate\" and \"needle\"");
  CHECK(replay.difference()->recorded.find("began, distance 0.25 to 0.5, 1 contacts") == 0);
  CHECK(replay.difference()->replayed.find("began, distance 0.25 to 0.25, 1 contacts") == 0);
}

TEST_CASE("recording: a writer that cannot follow drops frames, and the rest is answered again") {
  const TemporaryFile file;
  std::size_t dropped = 0;
  {
    const MovingScene moving;
    SceneSettings settings = settings_of(0.05, 0.25);
    settings.threads = 1;
    std::optional<Recorder> recorder;
    RandomCalls calls(5);
    Scene scene(settings);
    recorder.emplace(scene, file.path(), RecorderSettings{.keyframe_interval = 16, .waiting_frames = 1});
    for (std::size_t frame = 0; frame < 600; ++frame) {
      calls.make(scene);
      (void)scene.step();
    }
    recorder->close();
    dropped = recorder->statistics().dropped;
    CHECK(recorder->statistics().frames + dropped == 600);
  }
  CHECK(first_difference(file.path()) == "");
  const Recording recording(file.path());
  std::uint64_t told = 0;
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame)
    told += recording.frame(frame).dropped_before;
  CHECK(told <= dropped);
  CHECK(recording.frame_count() + dropped == 600);
}

TEST_CASE("recording: a ring keeps the last frames within its budget, and is written on demand") {
  const TemporaryFile file;
  const TemporaryFile told;
  SceneSettings settings = settings_of(0.5, 100);
  settings.threads = 1;
  NeedleOverPlate stage(settings);
  Recorder recorder(stage.scene,
                    RingSettings{.byte_budget = 1 << 20, .frames = 20, .on_diagnostic = told.path()},
                    patient(5));
  for (int frame = 0; frame < 100; ++frame) stage.step_at(frame / 128.0);
  recorder.write(file.path());
  {
    const Recording recording(file.path());
    CHECK(recording.frame_count() >= 20);
    CHECK(recording.frame_count() < 30);
    CHECK(recording.frame(recording.frame_count() - 1).frame == 100);
    CHECK(first_difference(file.path()) == "");
  }
  CHECK_FALSE(std::filesystem::exists(told.path()));
  stage.scene.set_positions(ObjectId{77, 1}, PositionView());
  (void)stage.scene.step();
  recorder.close();
  const Recording recording(told.path());
  CHECK(recording.frame(recording.frame_count() - 1).diagnostics == 1);
  CHECK(first_difference(told.path()) == "");
}

TEST_CASE("recording: replaced meshes are in a ring and in a part") {
  const TemporaryFile file;
  const TemporaryFile part;
  SceneSettings settings = settings_of(0.5, 100);
  settings.threads = 1;
  NeedleOverPlate stage(settings);
  Recorder recorder(stage.scene, RingSettings{.byte_budget = 1 << 20, .frames = 10}, patient(5));
  std::vector<std::string> texts;
  for (int frame = 0; frame < 43; ++frame) {
    const auto needle = std::make_shared<const Mesh>(Mesh::from_triangles(
        lifted(*needle_mesh(), frame / 128.0), std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
    if (frame % 3 == 0) stage.scene.replace_mesh(stage.needle, needle, std::vector<std::uint32_t>{2, 0, 1});
    if (frame % 4 == 0)
      stage.scene.replace_mesh(stage.plate, plate_mesh(), std::vector<std::uint32_t>{0, 1, 2, 3});
    texts.push_back(whole_text(*stage.scene.step()));
  }
  recorder.close();
  recorder.write(file.path());
  CHECK(first_difference(file.path()) == "");
  const Recording recording(file.path());
  CHECK(recording.frame_count() >= 10);
  CHECK(recording.mesh_count() < 20);
  cut_recording(recording, {.first_frame = 3, .last_frame = 8}, part.path());
  CHECK(first_difference(part.path()) == "");
  CHECK(Recording(part.path()).frame_count() == 6);
  Replay replay(recording);
  std::size_t at = texts.size() - recording.frame_count();
  const auto without_phase = [](const std::string& text) { return text.substr(text.find(' ', 1)); };
  while (replay.step()) CHECK(without_phase(whole_text(*replay.report())) == without_phase(texts[at++]));
}

TEST_CASE("recording: wrong settings, a second recorder and a bad file are refused") {
  Scene scene;
  const TemporaryFile file;
  CHECK(message_of([&] { Recorder recorder(scene, file.path(), {.keyframe_interval = 0}); }) ==
        "recorder: keyframe_interval is 0; it is at least 1");
  CHECK(message_of([&] { Recorder recorder(scene, file.path(), {.waiting_frames = 0}); }) ==
        "recorder: waiting_frames is 0; it is at least 1");
  CHECK(message_of([&] { Recorder recorder(scene, RingSettings{.frames = 0}); }) ==
        "recorder: frames is 0; it is at least 1, or has no value");
  CHECK(message_of([&] { Recorder recorder(scene, "/no/such/folder/file"); }).find("cannot be opened") !=
        std::string::npos);
  {
    Recorder recorder(scene, file.path());
    CHECK(message_of([&] { Recorder second(scene, RingSettings()); }) ==
          "recorder: another recorder is attached to the scene");
    CHECK(message_of([&] { recorder.write(file.path()); }) ==
          "recorder: it records into a file, and has no ring to write");
  }
  Recorder again(scene, RingSettings());
  (void)scene.step();
  again.close();
  again.close();
  CHECK(again.statistics().frames == 1);
}

TEST_CASE("recording: scene and recorder may go in any order") {
  const TemporaryFile file;
  auto scene = std::make_unique<Scene>(settings_of(0.5, 1));
  Recorder recorder(*scene, file.path(), patient());
  (void)scene->add(plate_mesh());
  scene->step_async(9);
  (void)scene->wait();
  scene.reset();
  recorder.close();
  const Recording recording(file.path());
  REQUIRE(recording.frame_count() == 1);
  CHECK(recording.frame(0).tag == 9);
}

}  // namespace graze::tests
