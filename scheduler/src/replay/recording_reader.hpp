#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <graze/mesh.hpp>
#include <graze/recording.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "recording/byte_buffer.hpp"
#include "recording/chunks.hpp"

namespace graze {

/// Reads the chunks of a recording's file. Every message begins with the file's name and the place.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& path);

  /// The places of a step and of the keyframe right before it.
  struct Step {
    std::uint64_t offset = 0;
    std::uint64_t keyframe_offset = 0;  ///< 0 where there is none
  };

  [[nodiscard]] const SettingsChunk& settings() const { return settings_; }
  [[nodiscard]] bool is_finished() const { return is_finished_; }
  /// FileEnd::dropped, or 0 where there is no end.
  [[nodiscard]] std::uint64_t dropped_at_end() const { return dropped_at_end_; }
  [[nodiscard]] std::uint64_t byte_count() const { return size_; }
  [[nodiscard]] std::span<const Step> steps() const { return steps_; }
  [[nodiscard]] std::size_t mesh_count() const { return meshes_.size(); }

  /// Calls `read(source)` with the payload of the chunk at an offset. Errors that it throws get the place.
  template <typename Read>
  void with_chunk(ChunkKind kind, std::uint64_t offset, ByteBuffer& payload, const Read& read) const {
    load(kind, offset, payload);
    try {
      ByteSource source(payload.bytes());
      read(source);
    } catch (const Error& error) {
      throw Error(place_of(kind, offset) + error.what());
    }
  }
  /// The last step up to `step` that has a keyframe. Throws Error where there is none.
  [[nodiscard]] std::size_t step_to_begin_at(std::size_t step) const;
  /// Calls `visit(record)` with the records of the keyframe of a step.
  template <typename Visit>
  void visit_keyframe(std::size_t step, ByteBuffer& payload, const Visit& visit) const {
    with_chunk(ChunkKind::keyframe, steps_[step].keyframe_offset, payload, [&](ByteSource& source) {
      std::uint64_t count = 0;
      source(count);
      visit_records(source, count, visit);
    });
  }
  /// The mesh of a number. It stays in memory as long as somebody uses it.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(std::uint32_t number) const;
  /// Reads the chunk of a mesh as it stands.
  void load_mesh(std::uint32_t number, ByteBuffer& chunk) const;
  void check_all() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  [[nodiscard]] ChunkHead head_at(std::uint64_t offset) const;
  void load(ChunkKind kind, std::uint64_t offset, ByteBuffer& payload) const;
  void check_file_head() const;
  [[nodiscard]] bool read_index();
  void scan();
  void add(const IndexEntry& entry);
  [[nodiscard]] std::string place_of(ChunkKind kind, std::uint64_t offset) const;
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what) const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
  bool is_finished_ = false;
  std::uint64_t dropped_at_end_ = 0;
  SettingsChunk settings_;
  std::vector<IndexEntry> entries_;
  std::vector<Step> steps_;
  std::uint64_t keyframe_offset_ = 0;  ///< of the last keyframe that was added
  std::map<std::uint32_t, std::uint64_t> meshes_;
  mutable std::map<std::uint32_t, std::weak_ptr<const Mesh>> read_meshes_;
};

}  // namespace graze
