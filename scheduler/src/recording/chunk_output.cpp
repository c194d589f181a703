#include "recording/chunk_output.hpp"

#include <cerrno>
#include <cstring>
#include <graze/error.hpp>
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
  write(chunk.bytes());
}

void FileOutput::finish() {
  const std::uint64_t index_offset = offset_;
  ByteBuffer chunk;
  begin_chunk(chunk);
  write_fields(chunk, index_);
  seal_chunk(chunk, ChunkKind::index, 0);
  write_checked(chunk, FileEnd{index_offset});
  write(chunk.bytes());
  if (std::fclose(file_.release()) != 0) fail("cannot be closed");
}

void FileOutput::write(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail("cannot be written");
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
  byte_count_ += chunk.size();
  if (kind == ChunkKind::settings) {
    settings_ = std::move(kept);
    return;
  }
  if (kind == ChunkKind::mesh) {
    meshes_[static_cast<std::uint32_t>(number)] = std::move(kept);
    return;
  }
  if (kind == ChunkKind::keyframe) segments_.emplace_back();
  Segment& segment = segments_.back();
  segment.chunks.push_back(std::move(kept));
  segment.byte_count += chunk.size();
  if (kind != ChunkKind::step) return;
  ++segment.frames;
  ++frames_;
  // The first segment goes when the others alone are as many frames as are wanted, or when all are too large.
  while (segments_.size() > 1 &&
         (byte_count_ > byte_budget_ || (frame_limit_ > 0 && frames_ - segments_[0].frames >= frame_limit_)))
    drop_oldest();
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

void RingOutput::write(const std::filesystem::path& path) const {
  std::vector<std::shared_ptr<const Chunk>> chunks;
  {
    const std::lock_guard lock(mutex_);
    if (settings_ != nullptr) chunks.push_back(settings_);
    for (const auto& [number, mesh] : meshes_) chunks.push_back(mesh);
    for (const Segment& segment : segments_)
      chunks.insert(chunks.end(), segment.chunks.begin(), segment.chunks.end());
  }
  FileOutput file(path);
  for (const auto& chunk : chunks) file.put(chunk->kind, chunk->number, chunk->bytes);
  file.finish();
}

std::uint64_t RingOutput::byte_count() const {
  const std::lock_guard lock(mutex_);
  return byte_count_;
}

}  // namespace graze
