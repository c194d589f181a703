#include "recording/chunk_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <graze/error.hpp>
#include <limits>
#include <utility>

namespace graze {

// ---- A file

FileOutput::FileOutput(const std::filesystem::path& path)
    : name_(path.string()), file_(std::fopen(name_.c_str(), "wb")) {
  if (file_ == nullptr) fail("cannot be opened");
  std::setvbuf(file_.get(), nullptr, _IONBF,
               0);  // a chunk is written at once, so a buffer would only copy it
  ByteBuffer head;
  write_checked(head, FileHead{});
  write(head.bytes());
}

void FileOutput::put(ChunkKind kind, std::uint64_t number, const ByteBuffer& chunk) {
  index_.push_back({kind, number, offset_});
  try {
    if (kind == ChunkKind::mesh) meshes_.insert(static_cast<std::uint32_t>(number));
  } catch (...) {
    index_.pop_back();
    throw;
  }
  write(chunk.bytes());
}

void FileOutput::finish(std::uint64_t dropped) {
  const std::uint64_t index_offset = offset_;
  ByteBuffer chunk;
  begin_chunk(chunk);
  write_fields(chunk, index_);
  seal_chunk(chunk, ChunkKind::index, 0);
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  write_checked(chunk, FileEnd{.index_offset = index_offset,
                               .dropped = static_cast<std::uint32_t>(std::min(dropped, most))});
  write(chunk.bytes());
  if (std::fclose(file_.release()) != 0) fail("cannot be closed");
}

/// After a chunk of which only a part was written there can be no other.
void FileOutput::write(std::span<const std::byte> bytes) {
  has_failed_ = has_failed_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size();
  if (has_failed_) fail("cannot be written");
  offset_ += bytes.size();
}

void FileOutput::fail(const char* what) const {
  throw Error(name_ + ": " + what + ": " + std::strerror(errno));
}

// ---- A ring

void RingOutput::put(ChunkKind kind, std::uint64_t number, const ByteBuffer& chunk) {
  auto kept = std::make_shared<Chunk>(Chunk{kind, number, {}});
  kept->bytes.append(chunk.bytes());
  const std::lock_guard lock(mutex_);
  if (kind == ChunkKind::settings)
    settings_ = std::move(kept);
  else if (kind == ChunkKind::mesh)
    meshes_.insert_or_assign(static_cast<std::uint32_t>(number), std::move(kept));
  else
    put_in_segment(kind, std::move(kept));
  byte_count_ += chunk.size();  // only now: what is above may throw
  if (kind != ChunkKind::step) return;
  // The first segment goes when the others alone are as many frames as are wanted, or when all are too large.
  while (segments_.size() > 1 &&
         (byte_count_ > byte_budget_ || (frame_limit_ && frames_ - segments_[0].frames >= *frame_limit_)))
    drop_oldest();
}

/// A keyframe begins a segment.
void RingOutput::put_in_segment(ChunkKind kind, std::shared_ptr<const Chunk> kept) {
  const std::size_t size = kept->bytes.size();
  if (kind == ChunkKind::keyframe) {
    Segment begun;
    begun.chunks.push_back(std::move(kept));
    begun.byte_count = size;
    segments_.push_back(std::move(begun));
    return;
  }
  Segment& segment = segments_.back();
  segment.chunks.push_back(std::move(kept));
  segment.byte_count += size;
  if (kind != ChunkKind::step) return;
  (segment.frames == 0 ? segment.dropped_before : segment.dropped_within) += dropped_before_next_;
  ++segment.frames;
  ++frames_;
}

bool RingOutput::has_mesh(std::uint32_t number) const {
  const std::lock_guard lock(mutex_);
  return meshes_.contains(number);
}

void RingOutput::use_mesh(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  segments_.back().meshes.insert(number);
}

void RingOutput::drop_oldest() {
  const Segment oldest = std::move(segments_.front());
  segments_.pop_front();
  byte_count_ -= oldest.byte_count;
  frames_ -= oldest.frames;
  for (const std::uint32_t mesh : oldest.meshes) {
    const auto is_used = [&](const Segment& segment) { return segment.meshes.contains(mesh); };
    if (std::any_of(segments_.begin(), segments_.end(), is_used)) continue;
    const auto found = meshes_.find(mesh);
    if (found == meshes_.end()) continue;
    byte_count_ -= found->second->bytes.size();
    meshes_.erase(found);
  }
}

RecorderStatistics RingOutput::write(const std::filesystem::path& path, std::uint64_t dropped_at_end) const {
  std::vector<std::shared_ptr<const Chunk>> chunks;
  RecorderStatistics written{.dropped = dropped_at_end};
  {
    const std::lock_guard lock(mutex_);
    if (settings_ != nullptr) chunks.push_back(settings_);
    for (const auto& [number, mesh] : meshes_) chunks.push_back(mesh);
    for (const Segment& segment : segments_) {
      chunks.insert(chunks.end(), segment.chunks.begin(), segment.chunks.end());
      // What is missing before the first frame of all is not missing in the file.
      written.dropped += segment.dropped_within + (written.frames > 0 ? segment.dropped_before : 0);
      written.frames += segment.frames;
    }
  }
  FileOutput file(path);
  for (const auto& chunk : chunks) file.put(chunk->kind, chunk->number, chunk->bytes);
  file.finish(dropped_at_end);
  written.bytes = file.byte_count();
  return written;
}

std::uint64_t RingOutput::byte_count() const {
  const std::lock_guard lock(mutex_);
  return byte_count_;
}

}  // namespace graze
