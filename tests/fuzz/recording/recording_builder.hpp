#pragma once

#include <cstdint>
#include <filesystem>
#include <graze/mesh.hpp>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "recording/chunk_output.hpp"
#include "recording/recorded_rows.hpp"
#include "recording/records.hpp"

namespace graze::fuzz {

/// Writes a recording of any records, whether they fit each other or not. Checksums, hashes and the index are
/// right. What records view has to stay until they are written.
class RecordingBuilder {
 public:
  RecordingBuilder(const std::filesystem::path& path, const SceneSettings& settings);

  /// Writes a mesh. They are numbered from 0.
  void add_mesh(const Mesh& mesh);
  /// Writes a keyframe of the next step.
  void add_keyframe(std::span<const Record> records);
  /// Writes a step. Its report lists these rows and nothing else.
  void add_step(std::span<const Record> records, const std::vector<RecordedRow>& rows = {},
                bool is_fresh = false);
  /// Writes the index and closes the file.
  void finish() { output_.finish(); }

 private:
  void put(ChunkKind kind, std::uint64_t number);

  FileOutput output_;
  ByteBuffer chunk_;
  std::uint32_t meshes_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace graze::fuzz
