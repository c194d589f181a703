#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <graze/report.hpp>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "calls/calls.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"
#include "recording/byte_buffer.hpp"
#include "recording/chunks.hpp"
#include "recording/records.hpp"

namespace graze {

/// Meshes by their numbers in a recording.
using NumberedMeshes = std::vector<std::pair<std::uint32_t, std::shared_ptr<const IndexedMesh>>>;

/// The calls and the report of one step, on their way to the thread that writes them.
struct CapturedFrame {
  std::uint64_t record_count = 0;
  ByteBuffer records;
  bool is_fresh = false;     ///< the records make the scene from an empty one
  bool is_snapshot = false;  ///< they say where its objects are, and not which calls the step took up
  std::uint64_t dropped_before = 0;
  NumberedMeshes meshes;  ///< all that its records name
  ReportHandle report;

  void clear();
};

/// A fixed number of frames that go round between the stepping thread and the writing one. A frame that is
/// free belongs to the stepping thread, and one that is full to the writing thread, so no lock is needed:
/// each side only moves its own counter.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t size) : frames_(size) {}

  // Stepping thread.
  /// The next frame to fill, or null while all frames are full.
  [[nodiscard]] CapturedFrame* free_frame();
  /// The next frame to fill. Waits while all frames are full.
  [[nodiscard]] CapturedFrame* wait_for_free_frame();
  /// Hands the frame that one of these returned to the writing thread.
  void push();
  /// No frame comes any more.
  void close();

  // Writing thread.
  /// Waits for the oldest full frame. Null when the queue is closed and empty.
  [[nodiscard]] CapturedFrame* wait_for_frame();
  /// Gives the frame that `wait_for_frame` returned back.
  void pop();
  /// Waits until all frames that were pushed have been popped. Any thread.
  void wait_until_empty();

  [[nodiscard]] std::size_t byte_count() const;

 private:
  static constexpr std::uint64_t closed_bit = std::uint64_t{1} << 63;

  std::vector<CapturedFrame> frames_;
  /// How many were pushed, and `closed_bit`. Release and acquire hand over what is in the frame.
  std::atomic<std::uint64_t> pushed_{0};
  std::atomic<std::uint64_t> popped_{0};
};

/// Writes down what a scene's steps take up, for a recorder. It only copies. Where no frame is free, the step
/// waits for one or is not captured, and the next one that is captured begins with the whole scene. Stepping
/// thread only, and it never throws: a step without memory for its capture counts as dropped.
class FrameCapture final : public MemoryObserver {
 public:
  FrameCapture(FrameQueue& queue, bool waits) : queue_(queue), waits_(waits) {}

  /// Begins a step, or goes on with the frame of a step that failed.
  void begin_step(const ObjectStore& store, const PairFilter& filter) noexcept;
  /// Sees a call, and applies it with `apply`. If that throws, the call is not recorded: it comes again.
  template <typename OneCall, typename Apply>
  void see(const OneCall& call, const Apply& apply) {
    const std::size_t size = frame_ == nullptr ? 0 : frame_->records.size();
    const std::uint64_t count = frame_ == nullptr ? 0 : frame_->record_count;
    see(call);
    try {
      apply();
    } catch (...) {
      if (frame_ != nullptr) {
        frame_->records.shrink(size);
        frame_->record_count = count;
      }
      throw;
    }
  }
  /// Sees all calls applied, before positions are read.
  void see_content(const PairFilter& filter) noexcept;
  /// Sees bound memory that the step has found new.
  void see_memory(const Object& object) noexcept override;
  /// Ends a step with its report.
  void end_step(const ReportHandle& report) noexcept;
  /// Says that nobody writes frames any more. Any thread.
  void close() noexcept { is_closed_.store(true, std::memory_order_release); }
  [[nodiscard]] bool is_closed() const noexcept { return is_closed_.load(std::memory_order_acquire); }
  /// Says that no frame can be written any more. All frames from now on count as dropped. Any thread.
  void give_up() noexcept { has_given_up_.store(true, std::memory_order_release); }
  [[nodiscard]] bool has_given_up() const noexcept { return has_given_up_.load(std::memory_order_acquire); }
  /// Lets the next frame that begins have the whole scene. Any thread.
  void ask_for_whole_scene() noexcept { wants_whole_scene_.store(true, std::memory_order_release); }
  /// How many frames were dropped. Any thread.
  [[nodiscard]] std::uint64_t dropped_count() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  template <typename OneCall>
  static constexpr bool is_told = Is<OneCall, Diagnostic>;

  template <typename OneCall>
  void see(const OneCall& call) noexcept {
    // A snapshot has the scene as it is after the calls, and of these only what is told.
    if (frame_ == nullptr || (frame_->is_snapshot && !is_told<OneCall>)) return;
    keep_or_drop([&] { add(call); });
  }
  template <typename Work>
  void keep_or_drop(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      drop();
    }
  }
  void drop() noexcept;
  template <typename OneRecord>
  void add_record(const OneRecord& record) {
    write_record(frame_->records, record);
    ++frame_->record_count;
  }
  std::uint32_t number_of(const std::shared_ptr<const IndexedMesh>& mesh);
  void add_object(const Object& object);
  void add_freezing_call(const Object& object);

  // The record of each kind of call.
  void add(const AddObject& call);
  void add(const ReplaceMesh& call);
  void add(const RemoveObject& call) { add_record(call); }
  void add(const SetPose& call) { add_record(call); }
  void add(const RefusePose& call) { add_record(call); }
  void add(const SetPositions& call);
  void add(const BindPositions& call);
  void add(const UnbindPositions& call);
  void add(const PositionsChanged& call) { add_record(call); }
  void add(const MarkTeleport& call) { add_record(call); }
  void add(const SettlePose& call) { add_record(call); }
  void add(const IgnorePair& call) { add_record(call); }
  void add(const IgnoreGroups& call) { add_record(call); }
  void add(const SetRule& call) { add_record(call); }
  void add(const Reserve& call) { add_record(call); }
  void add(const Diagnostic& call) { add_record(call); }

  struct KnownMesh {
    std::uint32_t number;
    std::weak_ptr<const IndexedMesh> mesh;  ///< another mesh may come to lie where this one was
  };

  FrameQueue& queue_;
  const bool waits_;  ///< for a free frame
  const ObjectStore* store_ = nullptr;
  CapturedFrame* frame_ = nullptr;  ///< null between steps, unless one failed, and while one is not captured
  bool is_complete_ = false;        ///< the recording has all that the scene's steps have taken up so far
  std::uint64_t dropped_before_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<bool> is_closed_{false};
  std::atomic<bool> has_given_up_{false};
  std::atomic<bool> wants_whole_scene_{false};
  std::uint32_t mesh_count_ = 0;
  std::unordered_map<const IndexedMesh*, KnownMesh> meshes_;
};

}  // namespace graze
