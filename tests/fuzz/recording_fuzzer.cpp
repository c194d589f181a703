// The input is a recording whose checksums are made right first, so that what is behind them is reached. It
// is read or refused, replayed from its first frame and from its last, and a part of it is cut out and
// replayed.

#include <algorithm>
#include <graze/error.hpp>
#include <graze/recording.hpp>

#include "finding.hpp"
#include "input_folder.hpp"
#include "recording/chunks.hpp"
#include "recording/crc32.hpp"

namespace graze::fuzz {
namespace {

/// Whether `work` does what it does. What it may do instead is to throw an Error of one line.
template <typename Work>
bool is_done(const Work& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    const std::string_view message = error.what();
    expect(!message.empty(), "a refusal without a word");
    return false;
  } catch (const std::exception& error) {
    finding(std::string("another exception than Error: ") + error.what());
  }
}

template <typename Head>
void seal(std::span<std::byte> bytes, Head head) {
  ByteBuffer sealed;
  write_checked(sealed, head);
  std::copy(sealed.bytes().begin(), sealed.bytes().end(), bytes.begin());
}

/// Gives the head of the file, and each chunk as far as they follow each other, the checksums of what they
/// hold. Nothing else changes but the version and the sizes that are beyond the end.
std::vector<std::byte> with_right_checksums(std::span<const std::uint8_t> input) {
  const auto given = std::as_bytes(input);
  std::vector<std::byte> bytes(given.begin(), given.end());
  if (bytes.size() < FileHead::size) return bytes;
  seal(std::span(bytes), FileHead{});
  for (std::size_t at = FileHead::size; bytes.size() - at >= ChunkHead::size;) {
    const std::span<std::byte> head_bytes = std::span(bytes).subspan(at, ChunkHead::size);
    ChunkHead head;
    (void)read_checked(head_bytes, head);
    const std::size_t room = bytes.size() - at - ChunkHead::size;
    head.payload_size =
        std::min<std::uint64_t>(head.payload_size, room) / position_alignment * position_alignment;
    const auto size = static_cast<std::size_t>(head.payload_size);
    head.payload_checksum = crc32(std::span(bytes).subspan(at + ChunkHead::size, size));
    seal(head_bytes, head);
    at += ChunkHead::size + size;
  }
  return bytes;
}

/// Scenes that would take long or much memory say nothing new.
bool is_small(const Recording& recording) {
  const SceneSettings& settings = recording.settings();
  return recording.frame_count() <= 16 && settings.region_distances <= 4096;
}

void replay(const Recording& recording, std::size_t first_frame) {
  Replay replay(recording, {.threads = 1, .first_frame = first_frame});
  std::vector<Eigen::Vector3d> positions;
  while (replay.step())
    for (std::size_t i = 0; i < replay.objects().size(); ++i) {
      replay.read_positions(i, positions);
      expect(positions.size() == replay.objects()[i].mesh->vertex_count(),
             "positions are not one for each vertex");
    }
}

void run(std::span<const std::uint8_t> input) {
  const std::vector<std::byte> bytes = with_right_checksums(input);
  const auto path =
      write_input("recording.graze", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  (void)is_done([&] {
    const Recording recording(path);
    (void)is_done([&] { recording.check(); });
    if (recording.frame_count() == 0 || !is_small(recording)) return;
    for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) (void)recording.frame(frame);
    (void)is_done([&] { replay(recording, 0); });
    (void)is_done([&] { replay(recording, recording.frame_count() - 1); });
    const auto part = input_folder() / "part.graze";
    if (is_done([&] {
          cut_recording(recording, {.first_frame = recording.frame_count() / 2, .objects = {0, 1}}, part);
        }))
      (void)is_done([&] { replay(Recording(part), 0); });
  });
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run({data, size});
  return 0;
}
