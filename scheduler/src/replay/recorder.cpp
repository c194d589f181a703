#include <algorithm>
#include <atomic>
#include <exception>
#include <graze/error.hpp>
#include <graze/recorder.hpp>
#include <mutex>
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
  void write_ring(const std::filesystem::path& path);
  [[nodiscard]] RecorderStatistics statistics() const;

 private:
  struct Link {
    explicit Link(std::size_t waiting) : queue(waiting), capture(queue) {}
    FrameQueue queue;
    FrameCapture capture;
  };

  State(const SceneSettings& scene, std::unique_ptr<FileOutput> file, std::unique_ptr<RingOutput> ring,
        std::filesystem::path on_diagnostic, const RecorderSettings& settings)
      : file_(std::move(file)),
        ring_(std::move(ring)),
        on_diagnostic_(std::move(on_diagnostic)),
        encoder_(output(), settings.keyframe_interval),
        link_(std::make_shared<Link>(settings.waiting_frames)) {
    encoder_.write_settings(scene, false);
  }
  [[nodiscard]] ChunkOutput& output() {
    if (file_ != nullptr) return *file_;
    return *ring_;
  }
  void write_frames() noexcept;
  void write_frame(const CapturedFrame& frame) noexcept;
  void tell_of_diagnostic(const CapturedFrame& frame) noexcept;

  std::unique_ptr<FileOutput> file_;  ///< either this or `ring_`
  std::unique_ptr<RingOutput> ring_;
  std::filesystem::path on_diagnostic_;  ///< empty once it is written
  FrameEncoder encoder_;
  bool is_broken_ = false;      ///< a frame could not be written
  std::exception_ptr problem_;  ///< of the writing thread; read after it has ended
  std::atomic<std::uint64_t> frames_{0};
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

/// After a frame that could not be written nothing more is: frames would be missing.
void Recorder::State::write_frame(const CapturedFrame& frame) noexcept {
  if (is_broken_) return;
  try {
    encoder_.write_frame(frame);
    frames_.fetch_add(1, std::memory_order_relaxed);
  } catch (...) {
    problem_ = std::current_exception();
    is_broken_ = true;
    link_->capture.close();
    return;
  }
  tell_of_diagnostic(frame);
}

/// Writes the ring once, with the first frame that has a diagnostic.
void Recorder::State::tell_of_diagnostic(const CapturedFrame& frame) noexcept {
  if (on_diagnostic_.empty() || frame.report->diagnostics().empty()) return;
  try {
    ring_->write(std::exchange(on_diagnostic_, {}));
  } catch (...) {
    problem_ = std::current_exception();
  }
}

void Recorder::State::finish() {
  const std::lock_guard lock(finishing_);
  stop();
  if (std::exchange(is_finished_, true)) return;
  if (problem_ != nullptr) std::rethrow_exception(problem_);
  if (file_ != nullptr) file_->finish();
}

void Recorder::State::write_ring(const std::filesystem::path& path) {
  if (ring_ == nullptr) throw Error("recorder: it records into a file, and has no ring to write");
  link_->queue.wait_until_empty();
  ring_->write(path);
}

RecorderStatistics Recorder::State::statistics() const {
  return {frames_.load(std::memory_order_relaxed), link_->capture.dropped_count(),
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
  state_ =
      std::make_unique<State>(scene.settings(), std::make_unique<RingOutput>(ring.byte_budget, ring.frames),
                              ring.on_diagnostic, checked(settings));
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

void Recorder::write(const std::filesystem::path& file) {
  state_->write_ring(file);
}

RecorderStatistics Recorder::statistics() const {
  return state_->statistics();
}

}  // namespace graze
