#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <graze/recorder.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "recording/byte_buffer.hpp"
#include "recording/chunks.hpp"

namespace graze {

/// A destination of a recording's chunks. Writing thread only.
class ChunkOutput {
 public:
  virtual ~ChunkOutput() = default;
  /// Takes a sealed chunk. Throws Error where it cannot be written. Where it throws std::bad_alloc, the
  /// output is as if the chunk had not come.
  virtual void put(ChunkKind kind, std::uint64_t number, const ByteBuffer& chunk) = 0;
  /// Whether the chunk of a mesh has been put, and is still there.
  [[nodiscard]] virtual bool has_mesh(std::uint32_t number) const = 0;
  /// Says how many dropped frames the next step tells of.
  virtual void count_dropped(std::uint64_t frames) = 0;
  /// Says that the last keyframe, or a step after it, adds an object of this mesh.
  virtual void use_mesh(std::uint32_t number) = 0;
};

/// A file of chunks, from the first byte to the last. Each chunk is handed to the system as a whole.
class FileOutput final : public ChunkOutput {
 public:
  /// Opens the file and writes its head. Throws Error.
  explicit FileOutput(const std::filesystem::path& path);
  void put(ChunkKind kind, std::uint64_t number, const ByteBuffer& chunk) override;
  [[nodiscard]] bool has_mesh(std::uint32_t number) const override { return meshes_.contains(number); }
  void count_dropped(std::uint64_t) override {}
  void use_mesh(std::uint32_t) override {}
  /// Writes the index and closes the file. `dropped` is FileEnd::dropped. Throws Error. May be called again
  /// where it throws std::bad_alloc.
  void finish(std::uint64_t dropped = 0);
  /// Any thread.
  [[nodiscard]] std::uint64_t byte_count() const { return offset_.load(std::memory_order_relaxed); }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void write(std::span<const std::byte> bytes);
  [[noreturn]] void fail(const char* what) const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::atomic<std::uint64_t> offset_{0};  ///< the writing thread alone changes it
  bool has_failed_ = false;               ///< a chunk may be there in part
  std::vector<IndexEntry> index_;
  std::set<std::uint32_t> meshes_;
};

/// The last frames in memory, within a budget. Frames are dropped from one keyframe to the next.
class RingOutput final : public ChunkOutput {
 public:
  RingOutput(std::size_t byte_budget, std::optional<std::uint64_t> frame_limit)
      : byte_budget_(byte_budget), frame_limit_(frame_limit) {}
  void put(ChunkKind kind, std::uint64_t number, const ByteBuffer& chunk) override;
  [[nodiscard]] bool has_mesh(std::uint32_t number) const override;
  void count_dropped(std::uint64_t frames) override { dropped_before_next_ = frames; }
  void use_mesh(std::uint32_t number) override;
  /// Writes what is there as a whole recording, after whose last frame so many were dropped. Returns what the
  /// file has. Any thread. Throws Error.
  RecorderStatistics write(const std::filesystem::path& path, std::uint64_t dropped_at_end) const;
  /// Any thread.
  [[nodiscard]] std::uint64_t byte_count() const;

 private:
  struct Chunk {
    ChunkKind kind;
    std::uint64_t number;
    ByteBuffer bytes;
  };
  /// A keyframe and the steps after it.
  struct Segment {
    std::vector<std::shared_ptr<const Chunk>> chunks;
    std::set<std::uint32_t> meshes;
    std::uint64_t byte_count = 0;
    std::uint64_t frames = 0;
    std::uint64_t dropped_before = 0;  ///< frames that are missing before its first step
    std::uint64_t dropped_within = 0;  ///< those that are missing after that
  };
  void put_in_segment(ChunkKind kind, std::shared_ptr<const Chunk> kept);
  void drop_oldest();

  std::size_t byte_budget_;
  std::optional<std::uint64_t> frame_limit_;
  std::uint64_t dropped_before_next_ = 0;  ///< of the writing thread alone
  mutable std::mutex mutex_;               ///< guards all below
  std::shared_ptr<const Chunk> settings_;
  std::map<std::uint32_t, std::shared_ptr<const Chunk>> meshes_;
  std::deque<Segment> segments_;
  std::uint64_t byte_count_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace graze
