// Recorders that lose frames: without memory in their own thread, without room on the disk, or with a writer
// that is too slow. What is lost is counted and told, and all else is answered again.

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scheduler/memory/failing_allocator.hpp"
#include "scheduler/random_calls.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "tools/slow_pipe.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

using Lack = FailingAllocator::Lack;

/// When memory is short, in frames of the scene: after the first, and up to the second.
struct Shortage {
  std::uint64_t place = FailingAllocator::never;  ///< of the first allocation that fails
  Lack lack = Lack::once;
  std::uint64_t begin = 8;
  std::uint64_t end = 9;
};

enum class Kept { in_file, in_ring };

/// What a recorder said, and the file that came of it.
struct Outcome {
  RecorderStatistics counted;
  std::optional<RecorderStatistics> written;  ///< of a ring
  std::uint64_t allocations = 0;              ///< while memory was short
};

constexpr std::uint64_t frames_played = 24;

SceneSettings one_thread_settings() {
  SceneSettings settings = settings_of(0.25, 1, ContactDetail::features);
  settings.threads = 1;
  return settings;
}

void wait_for_writer(const Recorder& recorder, std::uint64_t frames) {
  while (true) {
    const RecorderStatistics now = recorder.statistics();
    if (now.frames + now.dropped >= frames) return;
    std::this_thread::yield();
  }
}

/// Plays random calls. In the frames of the shortage the recorder's thread lacks memory. Each frame waits for
/// that thread, so a place names the same allocation in each run.
Outcome play_short_of_memory(unsigned seed, const Shortage& shortage, Kept kept,
                             const std::filesystem::path& file) {
  Outcome outcome;
  const auto play = [&] {
    FailingAllocator::exempt_this_thread();
    Scene scene(one_thread_settings());
    RandomCalls calls(seed);
    const RecorderSettings settings{.keyframe_interval = 5, .waiting_frames = 4};
    std::optional<Recorder> recorder;
    if (kept == Kept::in_file)
      recorder.emplace(scene, file, settings);
    else
      recorder.emplace(scene, RingSettings{.byte_budget = std::size_t{1} << 30}, settings);
    for (std::uint64_t frame = 0; frame < frames_played; ++frame) {
      if (frame == shortage.begin) FailingAllocator::begin(shortage.place, shortage.lack);
      // New meshes come while memory is short, since a recording has to have them too.
      if (frame == shortage.begin)
        (void)scene.add(std::make_shared<const Mesh>(Mesh::from_triangles(
            plate_mesh()->rest(), std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}})));
      calls.make(scene);
      (void)scene.step();
      wait_for_writer(*recorder, frame + 1);
      if (frame + 1 == shortage.end) outcome.allocations = FailingAllocator::end();
    }
    if (kept == Kept::in_ring) outcome.written = recorder->write(file);
    recorder->close();
    outcome.counted = recorder->statistics();
  };
  std::thread(play).join();
  return outcome;
}

std::string first_difference_in(const std::filesystem::path& file, std::size_t first_frame) {
  const Recording recording(file);
  Replay replay(recording, {.first_frame = first_frame});
  while (replay.step())
    if (const auto& difference = replay.difference())
      return "frame " + std::to_string(difference->frame) + ", " + difference->pair + "\n  recorded " +
             difference->recorded + "\n  replayed " + difference->replayed;
  return "";
}

/// Whether a recording has what is counted, tells where frames are missing, and is answered again from its
/// beginning and from where each gap ends.
void check_gaps(const std::filesystem::path& file, const RecorderStatistics& counted) {
  const Recording recording(file);
  recording.check();
  CHECK(recording.is_finished());
  REQUIRE(recording.frame_count() == counted.frames);
  std::uint64_t told = recording.dropped_at_end();
  CHECK(first_difference_in(file, 0) == "");
  for (std::size_t index = 0; index < recording.frame_count(); ++index) {
    const RecordedFrame frame = recording.frame(index);
    told += frame.dropped_before;
    const std::uint64_t before = index == 0 ? 0 : recording.frame(index - 1).frame;
    CHECK(frame.frame == before + frame.dropped_before + 1);
    if (frame.dropped_before == 0) continue;
    CHECK(frame.has_keyframe);
    CHECK(first_difference_in(file, index) == "");
  }
  CHECK(told == counted.dropped);
}

/// Lets each allocation of the recorder's thread fail in turn. Returns how many there are.
std::uint64_t fail_each(unsigned seed, Kept kept, Lack lack, std::uint64_t begin, std::uint64_t end,
                        std::uint64_t stride) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  for (std::uint64_t place = seed % stride;; place += stride) {
    INFO("seed " << seed << ", allocation " << place << ", in a ring: " << (kept == Kept::in_ring));
    const Outcome outcome = play_short_of_memory(seed, {place, lack, begin, end}, kept, file);
    CHECK(outcome.counted.frames + outcome.counted.dropped == frames_played);
    if (outcome.written) {
      CHECK(outcome.written->frames == outcome.counted.frames);
      // What is missing before the first frame of a ring is not missing in its file.
      CHECK(outcome.written->dropped == (begin == 0 ? 0 : outcome.counted.dropped));
      CHECK(outcome.written->bytes == std::filesystem::file_size(file));
    }
    check_gaps(file, outcome.counted);
    if (outcome.allocations <= place) {
      CHECK(outcome.counted.dropped == 0);
      return place;
    }
    if (lack == Lack::once) {
      CHECK(outcome.counted.dropped == 1);
    } else {
      CHECK(outcome.counted.dropped >= 1);
      CHECK(outcome.counted.dropped <= end - begin);
    }
  }
}

/// While it lives no file of this process becomes larger.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    (void)getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    (void)setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    (void)setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace

TEST_CASE("recording: a writer that lacks memory once drops one frame, and the next begins afresh") {
  std::uint64_t places = 0;
  for (unsigned seed = 0; seed < 4; ++seed)
    for (const Kept kept : {Kept::in_file, Kept::in_ring})
      places += fail_each(seed, kept, Lack::once, 8, 9, seed == 0 ? 3 : 13);
  CHECK(places > 100);
}

TEST_CASE("recording: a writer that lacks memory for some frames drops these and goes on") {
  for (unsigned seed = 4; seed < 7; ++seed)
    for (const Kept kept : {Kept::in_file, Kept::in_ring})
      (void)fail_each(seed, kept, Lack::from_then_on, 8, 12, 23);
}

TEST_CASE("recording: a writer that lacks memory for a frame with a keyframe begins afresh with the next") {
  for (const std::uint64_t begin : {0U, 5U})
    for (const Kept kept : {Kept::in_file, Kept::in_ring})
      (void)fail_each(7, kept, Lack::once, begin, begin + 1, 5);
}

TEST_CASE("recording: a writer sees a step that lacks memory, and the same step again") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  std::size_t failed = 0;
  for (std::uint64_t place = 0; place < 60; ++place) {
    INFO("allocation " << place);
    NeedleOverPlate stage(one_thread_settings());
    Recorder recorder(stage.scene, file);
    FailingAllocator::begin(place, Lack::once);
    try {
      stage.step_at(0.25);
    } catch (const std::bad_alloc&) {
      ++failed;
    }
    (void)FailingAllocator::end();
    stage.step_at(0.125);
    recorder.close();
    Recording(file).check();
    CHECK(first_difference_in(file, 0) == "");
  }
  CHECK(failed > 5);
}

TEST_CASE("recording: a ring that lacked memory in step 21 of 120 has the other 119") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  Outcome outcome;
  std::thread([&] {
    FailingAllocator::exempt_this_thread();
    NeedleOverPlate stage(one_thread_settings());
    Recorder recorder(stage.scene, RingSettings());
    for (std::uint64_t frame = 1; frame <= 120; ++frame) {
      if (frame == 21) FailingAllocator::begin(0, Lack::once);
      stage.step_at(static_cast<double>(frame) / 128);
      wait_for_writer(recorder, frame);
      if (frame == 21) CHECK(FailingAllocator::end() > 0);
    }
    outcome = {recorder.statistics(), recorder.write(file)};
    recorder.close();
  }).join();
  CHECK(outcome.counted.frames == 119);
  CHECK(outcome.counted.dropped == 1);
  CHECK(outcome.written->frames == 119);
  CHECK(outcome.written->dropped == 1);
  check_gaps(file, outcome.counted);
  CHECK(Recording(file).frame(20).frame == 22);
  CHECK(Recording(file).frame(20).dropped_before == 1);
}

TEST_CASE("recording: a ring tells what is missing at its end") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  std::thread([&] {
    FailingAllocator::exempt_this_thread();
    NeedleOverPlate stage(one_thread_settings());
    Recorder recorder(stage.scene, RingSettings());
    for (std::uint64_t frame = 1; frame <= 10; ++frame) {
      if (frame == 8) FailingAllocator::begin(0, Lack::from_then_on);
      stage.step_at(static_cast<double>(frame) / 16);
      wait_for_writer(recorder, frame);
    }
    const RecorderStatistics written = recorder.write(file);
    (void)FailingAllocator::end();
    CHECK(written.frames == 7);
    CHECK(written.dropped == 3);
    check_gaps(file, written);
    CHECK(Recording(file).dropped_at_end() == 3);
    stage.step_at(1);
    const RecorderStatistics later = recorder.write(file);
    CHECK(later.frames == 8);
    CHECK(later.dropped == 3);
    check_gaps(file, later);
    CHECK(Recording(file).dropped_at_end() == 0);
  }).join();
}

TEST_CASE("recording: a ring writes the file of a diagnostic when memory is there again") {
  const TemporaryFolder folder;
  const std::filesystem::path told = folder.path() / "told.graze";
  std::thread([&] {
    FailingAllocator::exempt_this_thread();
    NeedleOverPlate stage(one_thread_settings());
    Recorder recorder(stage.scene, RingSettings{.on_diagnostic = told});
    stage.step_at(0.5);
    wait_for_writer(recorder, 1);
    stage.scene.set_positions(ObjectId{77, 1}, PositionView());
    FailingAllocator::begin(0, Lack::from_then_on);
    (void)stage.scene.step();
    (void)recorder.write(folder.path() / "waits.graze");  // until the writer has tried
    (void)FailingAllocator::end();
    CHECK_FALSE(std::filesystem::exists(told));
    stage.step_at(0.25);
    recorder.close();
    const Recording recording(told);
    CHECK(recording.frame_count() == 2);
    CHECK(recording.frame(1).dropped_before == 1);
  }).join();
}

TEST_CASE(
    "recording: close() without memory for the file of a diagnostic writes it when it is called again") {
  const TemporaryFolder folder;
  std::uint64_t failed = 0;
  std::thread([&] {
    FailingAllocator::exempt_this_thread();
    for (std::uint64_t place = 0;; ++place) {
      INFO("allocation " << place);
      const std::filesystem::path told = folder.path() / ("told" + std::to_string(place) + ".graze");
      NeedleOverPlate stage(one_thread_settings());
      Recorder recorder(stage.scene, RingSettings{.on_diagnostic = told});
      stage.step_at(0.5);
      wait_for_writer(recorder, 1);
      stage.scene.set_positions(ObjectId{77, 1}, PositionView());
      FailingAllocator::begin(0, Lack::from_then_on);
      (void)stage.scene.step();
      (void)recorder.write(folder.path() / "waits.graze");  // until the writer has tried
      (void)FailingAllocator::end();
      bool lacked = false;
      FailingAllocator::begin(place, Lack::once);
      std::thread([&] {
        try {
          recorder.close();
        } catch (const std::bad_alloc&) {
          lacked = true;
        }
      }).join();
      (void)FailingAllocator::end();
      if (!lacked) break;
      ++failed;
      recorder.close();
      const Recording recording(told);
      CHECK(recording.is_finished());
      CHECK(recording.frame_count() == 1);
      CHECK(recording.dropped_at_end() == 1);
      std::filesystem::remove(told);
      recorder.close();
      CHECK_FALSE(std::filesystem::exists(told));  // it is written once
    }
  }).join();
  CHECK(failed > 2);
}

TEST_CASE("recording: a ring has a mesh that comes again long after its last object went") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  NeedleOverPlate stage(one_thread_settings());
  Recorder recorder(stage.scene, RingSettings{.frames = 10},
                    {.keyframe_interval = 4, .waiting_frames = 1000});
  const auto mesh = std::make_shared<const Mesh>(
      Mesh::from_triangles(plate_mesh()->rest(), std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  const ObjectId first = stage.scene.add(mesh);
  stage.step_at(0.25);
  stage.scene.remove(first);
  for (int frame = 0; frame < 40; ++frame) stage.step_at(0.25 + frame / 64.0);
  (void)stage.scene.add(mesh);
  stage.step_at(0.25);
  (void)recorder.write(file);
  CHECK(first_difference_in(file, 0) == "");
  CHECK(Recording(file).mesh_count() == 3);
}

TEST_CASE("recording: a writer whose disk is full counts what is lost, and close() tells why") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "run.graze";
  NeedleOverPlate stage(one_thread_settings());
  Recorder recorder(stage.scene, file);
  {
    const FileSizeLimit limit(4096);
    for (std::uint64_t frame = 1; frame <= 100; ++frame) {
      stage.step_at(static_cast<double>(frame) / 128);
      wait_for_writer(recorder, frame);
    }
  }
  const RecorderStatistics counted = recorder.statistics();
  CHECK(counted.frames > 0);
  CHECK(counted.dropped > 50);
  CHECK(counted.frames + counted.dropped == 100);
  std::string message;
  try {
    recorder.close();
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message.find("run.graze: cannot be written: ") != std::string::npos);
  const Recording recording(file);
  CHECK_FALSE(recording.is_finished());
  CHECK(recording.frame_count() == counted.frames);
  CHECK(first_difference_in(file, 0) == "");
}

TEST_CASE("recording: a writer that is waited for loses no frame, and one that is not drops some") {
  constexpr std::uint64_t frames = 150;
  for (const WhenBehind when : {WhenBehind::wait, WhenBehind::drop}) {
    const TemporaryFolder folder;
    SlowPipe pipe(folder / "pipe");
    Scene scene(one_thread_settings());
    Recorder recorder(scene, folder / "pipe",
                      {.keyframe_interval = 16, .waiting_frames = 2, .when_behind = when});
    RandomCalls calls(5);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
      calls.make(scene);
      if (frame % 2 == 0) {
        (void)scene.step();
      } else {
        scene.step_async();
        (void)scene.wait();
      }
    }
    recorder.close();
    const RecorderStatistics counted = recorder.statistics();
    CHECK(counted.frames + counted.dropped == frames);
    CHECK((counted.dropped == 0) == (when == WhenBehind::wait));
    check_gaps(folder.write("run.graze", pipe.bytes()), counted);
  }
}

}  // namespace graze::tests
