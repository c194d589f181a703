// Reads OFF files. graze does not use assimp (5.2) for this. That library moves a corner that names no vertex
// to the last one, and silently drops polygons of more than nine corners. It trusts the header's counts and
// keeps single precision only.

#include <string>
#include <string_view>

#include "mesh/raw_object.hpp"
#include "mesh/vertex_text.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

/// Lines that hold something, without comments.
class OffLines {
 public:
  explicit OffLines(std::string_view text) : lines_(text) {}

  /// Empty at the end of the file.
  std::string_view next() {
    while (!lines_.at_end()) {
      std::string_view line = lines_.next();
      line = trimmed(without_comment(line));
      if (!line.empty()) return line;
    }
    return {};
  }

  [[nodiscard]] std::size_t line() const { return lines_.line(); }

 private:
  TextLines lines_;
};

struct OffHeader {
  std::uint64_t vertex_count = 0;
  std::uint64_t face_count = 0;
};

/// OFF, COFF, NOFF, STOFF and so on in three dimensions, then the counts on the same line or the next.
OffHeader read_off_header(const std::filesystem::path& path, OffLines& lines) {
  std::string_view line = lines.next();
  const std::size_t letters = std::min(line.find_first_not_of("STCN"), line.size());
  line.remove_prefix(letters);
  if (!line.starts_with("OFF"))
    fail(path, lines.line(), "the file does not start with OFF (or COFF, NOFF, STOFF); save it as plain OFF");
  line.remove_prefix(3);
  std::string_view first = next_word(line);
  if (first == "BINARY") fail(path, lines.line(), "binary OFF is not read; save it as text");
  if (first.empty()) {
    line = lines.next();
    first = next_word(line);
  }
  const auto vertex_count = parse_number<std::uint64_t>(first);
  const auto face_count = parse_number<std::uint64_t>(next_word(line));
  if (!vertex_count || !face_count)
    fail(path, lines.line(), "the numbers of vertices and faces must stand here; correct the line");
  if (*vertex_count >= Mesh::no_edge || *face_count >= Mesh::no_edge)
    fail(path, lines.line(),
         "the file announces 2^32 vertices or faces or more; correct the line or split the mesh");
  return {*vertex_count, *face_count};
}

class OffReader {
 public:
  OffReader(const std::filesystem::path& path, std::string_view text) : path_(path), lines_(text) {}

  RawFile read() {
    const OffHeader header = read_off_header(path_, lines_);
    RawSurface surface;
    for (std::uint64_t i = 0; i < header.vertex_count; ++i)
      surface.positions.push_back(next_vertex(i, header));
    for (std::uint64_t i = 0; i < header.face_count; ++i) read_face(i, header, surface);
    RawFile file;
    file.objects.push_back({"", std::move(surface)});
    if (small_faces_ > 0)
      file.warnings.push_back(
          joined(path_.string(), ": ", small_faces_, " faces with fewer than 3 corners were left out"));
    return file;
  }

 private:
  Eigen::Vector3d next_vertex(std::uint64_t index, const OffHeader& header) {
    std::string_view line = lines_.next();
    if (line.empty()) fail_end("vertex", index, header.vertex_count);
    return read_vertex(line, path_, lines_.line());
  }

  void read_face(std::uint64_t index, const OffHeader& header, RawSurface& surface) {
    std::string_view line = lines_.next();
    if (line.empty()) fail_end("face", index, header.face_count);
    const auto count = parse_number<std::uint32_t>(next_word(line));
    if (!count) fail(path_, lines_.line(), "a face starts with its number of corners; correct the line");
    face_.clear();
    for (std::uint32_t corner = 0; corner < *count; ++corner) {
      const std::string_view word = next_word(line);
      const auto vertex = parse_number<std::uint32_t>(word);
      if (word.empty()) fail(path_, lines_.line(), "a face has fewer corners than it says; correct the line");
      if (!vertex || *vertex >= surface.positions.size())
        fail(path_, lines_.line(),
             joined("a face names vertex ", word, " of ", surface.positions.size(),
                    " (counted from 0); remove the face or add the vertex"));
      face_.push_back(*vertex);
    }
    if (face_.size() < 3)
      ++small_faces_;
    else
      surface.add_face(face_);
  }

  [[noreturn]] void fail_end(const std::string& what, std::uint64_t index, std::uint64_t count) {
    fail(path_, lines_.line(),
         joined("the file ends before ", what, " ", index, " of ", count,
                " (counted from 0); write it again"));
  }

  const std::filesystem::path& path_;
  OffLines lines_;
  std::vector<std::uint32_t> face_;
  std::size_t small_faces_ = 0;
};

}  // namespace

RawFile read_off(const std::filesystem::path& path) {
  const std::string text = read_bytes(path);
  return OffReader(path, text).read();
}

std::uint64_t announced_off_vertices(const std::filesystem::path& path) {
  const std::string text = read_bytes(path, header_bytes);
  OffLines lines(text);
  return read_off_header(path, lines).vertex_count;
}

}  // namespace graze::io
