#include <algorithm>
#include <atomic>
#include <exception>
#include <graze/error.hpp>
#include <graze/recorder.hpp>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>

#include "recording/frame_encoder.hpp"
#include "step/scene_state.hpp"

namespace graze {
namespace {

const RecorderSettings& checked(const RecorderSettings& settings) {
  if (settings.keyframe_interval == 0) throw Error("recorder: keyframe_interval is 0; it is at least 1");
  if (settings.waiting_frames == 0) throw Error("recorder: waiting_frames is 0; it is at least 1");
  return settings;
}

std::unique_ptr<RingOutput> make_ring(const RingSettings& settings) {
  if (settings.frames == 0U) throw Error("recorder: frames is 0; it is at least 1, or has no value");
  return std::make_unique<RingOutput>(settings.byte_budget, settings.frames);
}

}  // namespace

/// The recorder's thread, and what it shares with the stepping thread: the queue of frames. Both keep it
/// alive, so scene and recorder may go in any order.
class Recorder::State {
 public:
  State(const SceneSettings& scene, std::unique_ptr<FileOutput> file, const RecorderSettings& settings)
      : State(scene, std::move(file), nullptr, {}, settings) {}
  State(const SceneSettings& scene, std::unique_ptr<RingOutput> ring, std::filesystem::path on_diagnostic,
        const RecorderSettings& settings)
      : State(scene, nullptr, std::move(ring), std::move(on_diagnostic), settings) {}

  ~State() { stop(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[nodiscard]] std::shared_ptr<FrameCapture> capture() const { return {link_, &link_->capture}; }
  void start() {
    writer_ = std::thread([this] { write_frames(); });
  }
  void stop() noexcept {
    link_->capture.close();
    link_->queue.close();
    if (writer_.joinable()) writer_.join();
  }
  void finish();
  RecorderStatistics write_ring(const std::filesystem::path& path);
  [[nodiscard]] RecorderStatistics statistics() const;

 private:
  struct Link {
    explicit Link(const RecorderSettings& settings)
        : queue(settings.waiting_frames), capture(queue, settings.when_behind == WhenBehind::wait) {}
    FrameQueue queue;
    FrameCapture capture;
  };

  State(const SceneSettings& scene, std::unique_ptr<FileOutput> file, std::unique_ptr<RingOutput> ring,
        std::filesystem::path on_diagnostic, const RecorderSettings& settings)
      : file_(std::move(file)),
        ring_(std::move(ring)),
        on_diagnostic_(std::move(on_diagnostic)),
        encoder_(output(), settings.keyframe_interval),
        link_(std::make_shared<Link>(settings)) {
    encoder_.write_settings(scene, false);
  }
  [[nodiscard]] ChunkOutput& output() {
    if (file_ != nullptr) return *file_;
    return *ring_;
  }
  void write_frames() noexcept;
  void write_frame(const CapturedFrame& frame) noexcept;
  void skip_frame(const CapturedFrame& frame) noexcept;
  void tell_of_diagnostic() noexcept;
  [[nodiscard]] std::uint64_t dropped_count() const;
  [[nodiscard]] std::uint64_t dropped_at_end() const;

  std::unique_ptr<FileOutput> file_;  ///< either this or `ring_`
  std::unique_ptr<RingOutput> ring_;
  std::filesystem::path on_diagnostic_;
  bool must_write_on_diagnostic_ = false;  ///< a diagnostic has come, and that file is not written yet
  FrameEncoder encoder_;
  bool is_broken_ = false;      ///< the file takes no more frames
  std::exception_ptr problem_;  ///< of the writing thread, read after it has ended
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<std::uint64_t> skipped_{0};  ///< frames that were captured, and not written
  std::atomic<std::uint64_t> told_{0};     ///< dropped frames of which the written ones tell
  std::shared_ptr<Link> link_;
  std::thread writer_;
  std::mutex finishing_;
  bool is_finished_ = false;
};

void Recorder::State::write_frames() noexcept {
  while (CapturedFrame* const frame = link_->queue.wait_for_frame()) {
    write_frame(*frame);
    frame->report = ReportHandle();  // its memory goes back to the scene
    link_->queue.pop();
  }
}

/// A frame for which there is no memory is skipped. After one that a file does not take nothing more is
/// written: the file may end amid a frame.
void Recorder::State::write_frame(const CapturedFrame& frame) noexcept {
  if (!on_diagnostic_.empty() && !frame.report->diagnostics().empty()) must_write_on_diagnostic_ = true;
  if (is_broken_ || (encoder_.needs_whole_scene() && !frame.is_fresh)) return skip_frame(frame);
  try {
    told_.fetch_add(encoder_.write_frame(frame), std::memory_order_release);
    frames_.fetch_add(1, std::memory_order_relaxed);
  } catch (const std::bad_alloc&) {
    skip_frame(frame);
  } catch (...) {
    problem_ = std::current_exception();
    is_broken_ = true;
    link_->capture.give_up();
    skip_frame(frame);
  }
  tell_of_diagnostic();
}

/// The frame counts as dropped only when the whole scene has been asked for. So a step that begins after that
/// count captures it, and no second frame is dropped.
void Recorder::State::skip_frame(const CapturedFrame& frame) noexcept {
  if (!is_broken_) {
    encoder_.skip_frame(frame);
    if (encoder_.needs_whole_scene()) link_->capture.ask_for_whole_scene();
  }
  skipped_.fetch_add(1, std::memory_order_release);
}

/// Writes the ring once, with the first frame that has a diagnostic, or later where there is no memory for
/// it.
void Recorder::State::tell_of_diagnostic() noexcept {
  if (!must_write_on_diagnostic_) return;
  try {
    (void)ring_->write(on_diagnostic_, dropped_at_end());
  } catch (const std::bad_alloc&) {
    return;
  } catch (...) {
    problem_ = std::current_exception();
  }
  must_write_on_diagnostic_ = false;
  on_diagnostic_.clear();
}

void Recorder::State::finish() {
  const std::lock_guard lock(finishing_);
  stop();
  if (std::exchange(is_finished_, true)) return;
  if (problem_ != nullptr) std::rethrow_exception(problem_);
  try {
    if (file_ != nullptr) file_->finish(dropped_at_end());
    if (must_write_on_diagnostic_) (void)ring_->write(on_diagnostic_, dropped_at_end());
    must_write_on_diagnostic_ = false;
  } catch (const std::bad_alloc&) {
    is_finished_ = false;
    throw;
  }
}

RecorderStatistics Recorder::State::write_ring(const std::filesystem::path& path) {
  if (ring_ == nullptr) throw Error("recorder: it records into a file, and has no ring to write");
  link_->queue.wait_until_empty();
  return ring_->write(path, dropped_at_end());
}

std::uint64_t Recorder::State::dropped_count() const {
  return link_->capture.dropped_count() + skipped_.load(std::memory_order_acquire);
}

/// How many frames were dropped of which no frame tells that was written. What is told is read first, since a
/// frame is dropped before it is told.
std::uint64_t Recorder::State::dropped_at_end() const {
  const std::uint64_t told = told_.load(std::memory_order_acquire);
  return dropped_count() - told;
}

RecorderStatistics Recorder::State::statistics() const {
  return {frames_.load(std::memory_order_relaxed), dropped_count(),
          file_ != nullptr ? file_->byte_count() : ring_->byte_count()};
}

Recorder::Recorder(Scene& scene, const std::filesystem::path& file, const RecorderSettings& settings) {
  if (!scene.state_->stepper.can_attach()) throw Error("recorder: another recorder is attached to the scene");
  state_ = std::make_unique<State>(scene.settings(), std::make_unique<FileOutput>(file), checked(settings));
  scene.state_->stepper.attach(state_->capture());
  state_->start();
}

Recorder::Recorder(Scene& scene, const RingSettings& ring, const RecorderSettings& settings) {
  if (!scene.state_->stepper.can_attach()) throw Error("recorder: another recorder is attached to the scene");
  state_ = std::make_unique<State>(scene.settings(), make_ring(ring), ring.on_diagnostic, checked(settings));
  scene.state_->stepper.attach(state_->capture());
  state_->start();
}

Recorder::~Recorder() {
  try {
    close();
  } catch (...) {  // close() tells it to those who ask
  }
}

void Recorder::close() {
  state_->finish();
}

RecorderStatistics Recorder::write(const std::filesystem::path& file) {
  return state_->write_ring(file);
}

RecorderStatistics Recorder::statistics() const {
  return state_->statistics();
}

}  // namespace graze
