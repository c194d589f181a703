#include "replay/recording_reader.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <graze/error.hpp>
#include <limits>
#include <utility>

#include "recording/crc32.hpp"

namespace graze {

RecordingReader::RecordingReader(const std::filesystem::path& path)
    : name_(path.string()), file_(std::fopen(name_.c_str(), "rb")) {
  if (file_ == nullptr) throw Error(name_ + ": cannot be opened: " + std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // heads are small, and payloads are read as a whole
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) throw Error(name_ + ": has no size: " + error.message());
  check_file_head();
  is_finished_ = read_index();
  if (!is_finished_) scan();
  if (entries_.empty() || entries_[0].kind != ChunkKind::settings)
    fail(FileHead::size, "the recording does not begin with settings");
  ByteBuffer payload;
  with_chunk(ChunkKind::settings, entries_[0].offset, payload,
             [&](ByteSource& source) { source(settings_); });
}

void RecordingReader::check_file_head() const {
  std::array<std::byte, FileHead::size> bytes{};
  if (size_ < bytes.size()) fail(0, "the file is too short for a recording of graze");
  read_at(0, bytes);
  FileHead head;
  const bool is_whole = read_checked(bytes, head);
  if (head.magic != recording_magic) fail(0, "this is no recording of graze");
  if (!is_whole) fail(0, "the head of the file is damaged");
  if (head.version != recording_version)
    fail(0, "the recording is of version " + std::to_string(head.version) +
                ", and this graze reads version " + std::to_string(recording_version));
}

/// Reads the index at the end. Returns false where the file does not end with one.
bool RecordingReader::read_index() {
  std::array<std::byte, FileEnd::size> bytes{};
  if (size_ < FileHead::size + bytes.size()) return false;
  read_at(size_ - bytes.size(), bytes);
  FileEnd end;
  const bool is_whole = read_checked(bytes, end);
  if (!is_whole || end.magic != end_magic) return false;
  dropped_at_end_ = end.dropped;
  ByteBuffer payload;
  std::vector<IndexEntry> index;
  with_chunk(ChunkKind::index, end.index_offset, payload, [&](ByteSource& source) { source(index); });
  add_indexed(index, end.index_offset);
  return true;
}

/// Takes up an index that names each chunk of the file, from the first byte to the index itself.
void RecordingReader::add_indexed(const std::vector<IndexEntry>& index, std::uint64_t index_offset) {
  std::uint64_t next = FileHead::size;
  const auto has_end = [&](std::uint64_t offset) {
    if (offset != next) fail(next, "the index does not name what stands here");
  };
  for (const IndexEntry& entry : index) {
    has_end(entry.offset);
    const ChunkHead head = head_at(next);
    if (head.kind != entry.kind || head.number != entry.number)
      fail(next, "the index names another chunk than the one that stands here");
    add(entry);
    next = end_of(head, next);
  }
  has_end(index_offset);
  if (end_of(head_at(next), next) + FileEnd::size != size_) fail(next, "the index is not the last chunk");
}

/// The place after a chunk.
std::uint64_t RecordingReader::end_of(const ChunkHead& head, std::uint64_t offset) const {
  if (head.payload_size > size_ - offset - ChunkHead::size)
    fail(offset, "the file ends within the " + std::string(name_of(head.kind)) + " chunk");
  return offset + ChunkHead::size + head.payload_size;
}

/// Finds the chunks of a file without an index, one after the other, up to the last whole one.
void RecordingReader::scan() {
  for (std::uint64_t offset = FileHead::size; offset + ChunkHead::size <= size_;) {
    const ChunkHead head = head_at(offset);
    if (head.payload_size > size_ - offset - ChunkHead::size) return;
    if (head.kind == ChunkKind::index) {
      // A chunk follows that names the index. It is damaged, or it would have been found.
      if (offset + ChunkHead::size + head.payload_size + FileEnd::size == size_)
        fail(size_ - FileEnd::size, "the end of the file is damaged");
      return;
    }
    add({head.kind, head.number, offset});
    offset += ChunkHead::size + head.payload_size;
  }
}

/// Adds the next chunk of the file.
void RecordingReader::add(const IndexEntry& entry) {
  const bool is_first = entries_.empty();
  entries_.push_back(entry);
  switch (entry.kind) {
    case ChunkKind::settings:
      if (!is_first) fail(entry.offset, "the settings stand in the recording twice");
      return;
    case ChunkKind::mesh:
      return add_mesh(entry);
    case ChunkKind::keyframe:
      keyframe_ = entry;  // in place of one whose frame was dropped, since there was no memory for it
      return;
    case ChunkKind::step:
      return add_step(entry);
    case ChunkKind::index:
      fail(entry.offset, "an index stands amid the recording");
  }
  fail(entry.offset, "the chunk is of a kind that is not known");
}

void RecordingReader::add_mesh(const IndexEntry& entry) {
  if (entry.number > std::numeric_limits<std::uint32_t>::max())
    fail(entry.offset, "the number of the mesh is too large");
  if (!meshes_.emplace(static_cast<std::uint32_t>(entry.number), entry.offset).second)
    fail(entry.offset, "mesh " + std::to_string(entry.number) + " stands in the recording twice");
}

void RecordingReader::add_step(const IndexEntry& entry) {
  const auto keyframe = std::exchange(keyframe_, std::nullopt);
  if (keyframe && keyframe->number != entry.number)
    fail(keyframe->offset, "the keyframe is of frame " + std::to_string(keyframe->number) + ", and frame " +
                               std::to_string(entry.number) + " follows");
  steps_.push_back({entry.offset, keyframe ? keyframe->offset : 0, entry.number, entries_.size() - 1});
}

void RecordingReader::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  const bool is_read = std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET) == 0 &&
                       std::fread(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size();
  if (!is_read) fail(offset, "the file cannot be read here");
}

ChunkHead RecordingReader::head_at(std::uint64_t offset) const {
  if (offset > size_ || size_ - offset < ChunkHead::size) fail(offset, "the file ends before a chunk");
  std::array<std::byte, ChunkHead::size> bytes{};
  read_at(offset, bytes);
  ChunkHead head;
  if (!read_checked(bytes, head)) fail(offset, "the head of a chunk is damaged");
  if (head.payload_size % position_alignment != 0) fail(offset, "the size of a chunk is no multiple of 8");
  return head;
}

void RecordingReader::load(ChunkKind kind, std::uint64_t offset, ByteBuffer& payload) const {
  const ChunkHead head = head_at(offset);
  if (head.kind != kind)
    fail(offset,
         std::string("there is a chunk of another kind than the ") + name_of(kind) + " that is expected");
  (void)end_of(head, offset);
  payload.clear();
  const std::span<std::byte> bytes = payload.grow(static_cast<std::size_t>(head.payload_size));
  read_at(offset + ChunkHead::size, bytes);
  if (crc32(bytes) != head.payload_checksum)
    fail(offset, "the " + std::string(name_of(kind)) + " chunk of number " + std::to_string(head.number) +
                     " is damaged: its checksum is another");
}

std::size_t RecordingReader::step_to_begin_at(std::size_t step) const {
  while (step > 0 && steps_[step].keyframe_offset == 0) --step;
  if (steps_[step].keyframe_offset == 0)
    fail(steps_[step].offset, "the recording does not begin with a keyframe");
  return step;
}

std::shared_ptr<const Mesh> RecordingReader::mesh(std::uint32_t number) const {
  if (auto read = read_meshes_[number].lock()) return read;
  const auto found = meshes_.find(number);
  if (found == meshes_.end()) throw Error("mesh " + std::to_string(number) + " is not in the recording");
  std::shared_ptr<const Mesh> mesh;
  ByteBuffer payload;
  with_chunk(ChunkKind::mesh, found->second, payload, [&](ByteSource& source) { mesh = read_mesh(source); });
  read_meshes_[number] = mesh;
  return mesh;
}

void RecordingReader::load_mesh(std::uint32_t number, ByteBuffer& chunk) const {
  const auto found = meshes_.find(number);
  if (found == meshes_.end()) throw Error("mesh " + std::to_string(number) + " is not in the recording");
  ByteBuffer payload;
  load(ChunkKind::mesh, found->second, payload);
  begin_chunk(chunk);
  chunk.append(payload.bytes());
  seal_chunk(chunk, ChunkKind::mesh, number);
}

StepHead RecordingReader::step_head(std::size_t step, ByteBuffer& payload) const {
  StepHead head;
  with_chunk(ChunkKind::step, steps_[step].offset, payload, [&](ByteSource& source) { source(head); });
  return head;
}

void RecordingReader::check_keyframe(std::size_t step, ByteBuffer& payload) const {
  RecordCheck check = new_check();
  visit_keyframe(step, payload, check, [](const Record&) {});
}

void RecordingReader::check_passed(std::size_t step, ByteBuffer& payload) const {
  const std::size_t begin = step == 0 ? 0 : steps_[step - 1].entry + 1;
  const std::size_t end = step + 1 == steps_.size() ? entries_.size() : steps_[step].entry;
  for (std::size_t at = begin; at < end; ++at) {
    const IndexEntry& entry = entries_[at];
    if (entry.kind != ChunkKind::step) load(entry.kind, entry.offset, payload);
  }
  if (steps_[step].keyframe_offset != 0) check_keyframe(step, payload);
}

void RecordingReader::check_all() const {
  ByteBuffer payload;
  if (steps_.empty())
    for (const IndexEntry& entry : entries_) load(entry.kind, entry.offset, payload);
  RecordCheck check = new_check();
  const auto ignore = [](const auto&) {};
  for (std::size_t step = 0; step < steps_.size(); ++step) {
    check_passed(step, payload);
    if (step == 0) visit_keyframe(step_to_begin_at(0), payload, check, ignore);
    (void)visit_step(step, payload, check, ignore, ignore);
  }
}

std::string RecordingReader::place_of(ChunkKind kind, std::uint64_t offset) const {
  return name_ + ": byte " + std::to_string(offset) + ": " + name_of(kind) + " chunk: ";
}

void RecordingReader::fail(std::uint64_t offset, const std::string& what) const {
  throw PlacedError(name_ + ": byte " + std::to_string(offset) + ": " + what);
}

}  // namespace graze
