#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <graze/mesh.hpp>
#include <graze/recording.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "recording/byte_buffer.hpp"
#include "recording/chunks.hpp"
#include "replay/record_check.hpp"

namespace graze {

/// Reads the chunks of a recording's file. Every message begins with the file's name and the place.
///
/// The constructor reads the head of every chunk, so that an index is what the file holds. Payloads are read
/// when they are asked for. Each is checked before it is used, and so is each record.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& path);

  /// The places of a step and of the keyframe right before it.
  struct Step {
    std::uint64_t offset = 0;
    std::uint64_t keyframe_offset = 0;  ///< 0 where there is none
    std::uint64_t number = 0;           ///< of its chunk
    std::size_t entry = 0;              ///< into `entries_`
  };

  [[nodiscard]] const SettingsChunk& settings() const { return settings_; }
  [[nodiscard]] bool is_finished() const { return is_finished_; }
  /// FileEnd::dropped, or 0 where there is no end.
  [[nodiscard]] std::uint64_t dropped_at_end() const { return dropped_at_end_; }
  [[nodiscard]] std::uint64_t byte_count() const { return size_; }
  [[nodiscard]] std::span<const Step> steps() const { return steps_; }
  [[nodiscard]] std::size_t mesh_count() const { return meshes_.size(); }

  /// The last step up to `step` that has a keyframe. Throws Error where there is none.
  [[nodiscard]] std::size_t step_to_begin_at(std::size_t step) const;
  /// A check of records from an empty scene on.
  [[nodiscard]] RecordCheck new_check() const {
    return RecordCheck([this](std::uint32_t number) { return mesh(number); });
  }
  /// The head of a step, with its report.
  [[nodiscard]] StepHead step_head(std::size_t step, ByteBuffer& payload) const;
  /// Calls `visit(record)` with the records of the keyframe of a step. `check` begins with them.
  template <typename Visit>
  void visit_keyframe(std::size_t step, ByteBuffer& payload, RecordCheck& check, const Visit& visit) const {
    with_chunk(ChunkKind::keyframe, steps_[step].keyframe_offset, payload, [&](ByteSource& source) {
      std::uint64_t count = 0;
      source(count);
      check.clear();
      visit_checked(source, count, check, visit);
    });
  }
  /// Calls `begin(head)` with the head of a step, then `visit(record)` with its records. Returns what `begin`
  /// has left of the head. `check` goes on from the keyframe, or the step, before.
  template <typename Begin, typename Visit>
  StepHead visit_step(std::size_t step, ByteBuffer& payload, RecordCheck& check, const Begin& begin,
                      const Visit& visit) const {
    StepHead head;
    with_chunk(ChunkKind::step, steps_[step].offset, payload, [&](ByteSource& source) {
      source(head);
      if (head.report.frame != steps_[step].number)
        throw Error("the report is of frame " + std::to_string(head.report.frame) +
                    ", and the chunk of frame " + std::to_string(steps_[step].number));
      if (head.is_fresh) check.clear();
      begin(head);
      visit_checked(source, head.record_count, check, visit);
    });
    return head;
  }
  /// Checks what stands between the step before and this one: meshes, and the keyframe. After the last step
  /// also what follows.
  void check_passed(std::size_t step, ByteBuffer& payload) const;
  /// The mesh of a number. It stays in memory as long as somebody uses it.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(std::uint32_t number) const;
  /// Reads the chunk of a mesh as it stands.
  void load_mesh(std::uint32_t number, ByteBuffer& chunk) const;
  /// Reads and checks every chunk and every record.
  void check_all() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  /// An Error whose message names the place.
  class PlacedError : public Error {
   public:
    using Error::Error;
  };
  /// Calls `read(source)` with the payload of the chunk at an offset. Errors that it throws get the place.
  template <typename Read>
  void with_chunk(ChunkKind kind, std::uint64_t offset, ByteBuffer& payload, const Read& read) const {
    load(kind, offset, payload);
    try {
      ByteSource source(payload.bytes());
      read(source);
    } catch (const PlacedError&) {
      throw;  // of a mesh that a record names
    } catch (const Error& error) {
      throw PlacedError(place_of(kind, offset) + error.what());
    }
  }
  /// Calls `visit(record)` with so many records, each of which fits those before.
  template <typename Visit>
  static void visit_checked(ByteSource& source, std::uint64_t count, RecordCheck& check, const Visit& visit) {
    std::uint64_t number = 0;
    try {
      visit_records(source, count, [&](const Record& record) {
        check.check(record);
        visit(record);
        ++number;
      });
    } catch (const PlacedError&) {
      throw;
    } catch (const Error& error) {
      throw Error("record " + std::to_string(number) + ": " + error.what());
    }
  }
  void check_keyframe(std::size_t step, ByteBuffer& payload) const;
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  [[nodiscard]] ChunkHead head_at(std::uint64_t offset) const;
  void load(ChunkKind kind, std::uint64_t offset, ByteBuffer& payload) const;
  void check_file_head() const;
  [[nodiscard]] bool read_index();
  void add_indexed(const std::vector<IndexEntry>& index, std::uint64_t index_offset);
  void scan();
  void add(const IndexEntry& entry);
  void add_mesh(const IndexEntry& entry);
  void add_step(const IndexEntry& entry);
  [[nodiscard]] std::uint64_t end_of(const ChunkHead& head, std::uint64_t offset) const;
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
  std::optional<IndexEntry> keyframe_;  ///< the last one that was added, until its step is
  std::map<std::uint32_t, std::uint64_t> meshes_;
  mutable std::map<std::uint32_t, std::weak_ptr<const Mesh>> read_meshes_;
};

}  // namespace graze
