// STL is read here and not by assimp (5.2), which takes a binary file that begins with "solid" for text and
// refuses bytes behind the last face.

#include "formats/read_stl.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/raw_object.hpp"
#include "mesh/vertex_text.hpp"
#include "mesh/weld.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t first_face = 84;
constexpr std::size_t face_size = 50;

/// A surface whose vertices are given face by face.
class Soup {
 public:
  void add(const Eigen::Vector3d& vertex) { body_.vertices.push_back(vertex); }
  void drop_last(std::size_t count) { body_.vertices.resize(body_.vertices.size() - count); }
  void end_face(std::uint32_t corners) {
    for (std::uint32_t i = corners; i > 0; --i)
      surface_.corners.push_back(static_cast<std::uint32_t>(body_.vertices.size()) - i);
    surface_.corner_counts.push_back(corners);
  }

  /// Welds the vertices that are equal.
  RawObject finish(std::string name) {
    const auto numbers = weld(body_);
    for (auto& corner : surface_.corners) corner = numbers[corner];
    surface_.positions = std::move(body_.vertices);
    return {std::move(name), std::move(surface_)};
  }

 private:
  Body body_;
  RawSurface surface_;
};

/// Faces that would fit into the bytes behind the header.
std::uint64_t faces_there(std::string_view bytes) {
  return (bytes.size() - first_face) / face_size;
}

/// "solid" begins a text, but the header of many binary files as well. A binary file has the size that its
/// count says, or bytes that no text has.
bool is_text(std::string_view bytes) {
  std::string_view start = bytes.substr(0, 1024);
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  if (lower_case(next_word(start)) != "solid") return false;
  if (bytes.size() >= first_face &&
      first_face + face_size * std::uint64_t{word_at(bytes, header_size)} == bytes.size())
    return false;
  return bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

RawFile read_binary(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.size() < first_face)
    fail(path,
         joined("this is neither a text that begins with 'solid' nor as long as the 84 bytes of a binary "
                "header; write the file again"));
  const std::uint64_t count = word_at(bytes, header_size);
  const std::uint64_t there = faces_there(bytes);
  if (count == 0)
    fail(path, joined("byte 80: the header announces 0 faces, and ", bytes.size() - first_face,
                      " bytes follow; write the file again with its count"));
  if (count > there)
    fail(path, joined("byte ", bytes.size(), ": the file ends after ", there, " of the ", count,
                      " faces that its header announces; write it again"));
  Soup soup;
  for (std::uint64_t face = 0; face < count; ++face) {
    const std::size_t corners = first_face + face * face_size + 12;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d vertex;
      for (std::size_t axis = 0; axis < 3; ++axis)
        vertex[static_cast<Eigen::Index>(axis)] =
            static_cast<double>(std::bit_cast<float>(word_at(bytes, corners + 12 * corner + 4 * axis)));
      soup.add(vertex);
    }
    soup.end_face(3);
  }
  RawFile file;
  file.objects.push_back(soup.finish(""));
  const std::uint64_t left = bytes.size() - first_face - count * face_size;
  if (left > 0)
    file.warnings.push_back(
        joined(path.string(), ": ", left, " bytes behind the last of its ", count, " faces were left out"));
  return file;
}

/// A text of `solid NAME`, `facet`, `outer loop`, three `vertex X Y Z`, `endloop`, `endfacet`, `endsolid`.
class TextReader {
 public:
  TextReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), lines_(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text) {}

  RawFile read() {
    while (!lines_.at_end()) {
      std::string_view rest = lines_.next();
      read_line(lower_case(next_word(rest)), rest);
    }
    if (is_in_solid_)
      fail(path_, lines_.line(),
           joined("the file ends after ", faces_, " faces of solid '", name_,
                  "' without its 'endsolid'; write it again"));
    if (small_faces_ > 0)
      file_.warnings.push_back(
          joined(path_.string(), ": ", small_faces_, " faces with fewer than 3 corners were left out"));
    return std::move(file_);
  }

 private:
  void read_line(const std::string& word, std::string_view rest) {
    if (word == "solid")
      start_solid(rest);
    else if (word == "vertex")
      add_vertex(rest);
    else if (word == "outer")
      corners_ = 0;
    else if (word == "endloop")
      end_loop();
    else if (word == "endsolid" || (word == "end" && lower_case(next_word(rest)) == "solid"))
      end_solid();
    else if (word != "facet" && word != "endfacet" && !word.empty())
      fail(path_, lines_.line(), joined("'", word, "' is no word of an STL file; correct the line"));
  }

  void start_solid(std::string_view rest) {
    if (is_in_solid_) end_solid();
    name_ = trimmed(rest);
    is_in_solid_ = true;
    faces_ = 0;
  }

  void add_vertex(std::string_view rest) {
    soup_.add(read_vertex(rest, path_, lines_.line()));
    ++corners_;
  }

  void end_loop() {
    if (corners_ >= 3) {
      soup_.end_face(corners_);
      ++faces_;
    } else {
      soup_.drop_last(corners_);
      ++small_faces_;
    }
    corners_ = 0;
  }

  void end_solid() {
    if (corners_ > 0) fail(path_, lines_.line(), "a face has no 'endloop'; correct the line");
    file_.objects.push_back(std::exchange(soup_, {}).finish(name_));
    is_in_solid_ = false;
  }

  const std::filesystem::path& path_;
  TextLines lines_;
  Soup soup_;
  RawFile file_;
  std::string name_;
  bool is_in_solid_ = false;
  std::uint32_t corners_ = 0;  ///< of the face that is open
  std::size_t faces_ = 0;
  std::size_t small_faces_ = 0;
};

}  // namespace

RawFile read_stl(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  return is_text(bytes) ? TextReader(path, bytes).read() : read_binary(path, bytes);
}

}  // namespace graze::io
