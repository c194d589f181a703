// An input that begins as a recording does is one, whose checksums are made right first, so that what is
// behind them is reached. From other inputs a recording is made, with records of every kind. It is read or
// refused, replayed from its first frame and from its last, and parts of it are cut out and replayed.

#include <algorithm>
#include <cstring>

#include "finding.hpp"
#include "fuzz/recording/made_recording.hpp"
#include "fuzz/recording/recording_judge.hpp"
#include "input_folder.hpp"
#include "recording/chunks.hpp"
#include "recording/crc32.hpp"

namespace graze::fuzz {
namespace {

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

bool begins_as_recording(std::span<const std::uint8_t> input) {
  return input.size() >= recording_magic.size() &&
         std::memcmp(input.data(), recording_magic.data(), recording_magic.size()) == 0;
}

void run(std::span<const std::uint8_t> input) {
  const bool is_recording = begins_as_recording(input);
  const auto path = input_folder() / "recording.graze";
  if (is_recording) {
    const std::vector<std::byte> bytes = with_right_checksums(input);
    (void)write_input("recording.graze", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } else {
    make_recording(path, input);
  }
  const std::string problem = problem_of_recording(path, input_folder().path(), !is_recording);
  if (!problem.empty()) finding(problem);
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run({data, size});
  return 0;
}
