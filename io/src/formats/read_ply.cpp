// PLY is read here and not by assimp (5.2), which keeps single precision only and takes corners that name no
// vertex.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "formats/ply_header.hpp"
#include "mesh/raw_object.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"

namespace graze::io {
namespace {

template <typename T>
double number_at(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> raw;
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = bytes[swap ? raw.size() - 1 - i : i];
  return static_cast<double>(std::bit_cast<T>(raw));
}

/// The numbers after the header, one by one. Every PLY number is a double without loss.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view body, PlyEncoding encoding)
      : rest_(body), is_text_(encoding == PlyEncoding::ascii), swap_(is_swapped(encoding)) {}

  /// Nothing at the end of the file, and where a word is no number.
  std::optional<double> next(PlyType type) {
    if (is_text_) return parse_number<double>(next_word(rest_));
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    return std::nullopt;
  }

 private:
  static bool is_swapped(PlyEncoding encoding) {
    return encoding != PlyEncoding::ascii &&
           (encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little);
  }

  template <typename T>
  std::optional<double> take() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    const double number = number_at<T>(rest_.data(), swap_);
    rest_.remove_prefix(sizeof(T));
    return number;
  }

  std::string_view rest_;
  bool is_text_;
  bool swap_;
};

std::uint64_t vertex_rows(const PlyHeader& header) {
  return std::ranges::find(header.elements, "vertex", &PlyElement::name)->row_count;
}

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path),
        header_(read_ply_header(path, bytes)),
        numbers_(bytes.substr(header_.body_begin), header_.encoding) {}

  RawFile read() {
    const std::uint64_t vertex_count = vertex_rows(header_);
    for (const auto& element : header_.elements) read_element(element, vertex_count);
    RawFile file;
    file.objects.push_back({"", std::move(surface_)});
    if (small_faces_ > 0)
      file.warnings.push_back(
          joined(path_.string(), ": ", small_faces_, " faces with fewer than 3 corners were left out"));
    return file;
  }

 private:
  /// Which of an element's properties are of use.
  struct Columns {
    std::array<std::size_t, 3> axes = {none, none, none};
    std::size_t corners = none;
    bool is_strip = false;
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
  };

  [[nodiscard]] Columns columns_of(const PlyElement& element) const {
    Columns columns;
    const bool is_vertex = element.name == "vertex";
    columns.is_strip = element.name == "tristrips";
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (is_vertex && !property.length_type && property.name.size() == 1 && property.name[0] >= 'x' &&
          property.name[0] <= 'z')
        columns.axes[static_cast<std::size_t>(property.name[0] - 'x')] = i;
      if ((element.name == "face" || columns.is_strip) && property.length_type &&
          (property.name == "vertex_indices" || property.name == "vertex_index"))
        columns.corners = i;
    }
    for (const auto axis : columns.axes)
      if (is_vertex && axis == Columns::none) fail(path_, "header: the vertices lack x, y or z; write them");
    return columns;
  }

  void read_element(const PlyElement& element, std::uint64_t vertex_count) {
    const Columns columns = columns_of(element);
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row < element.row_count; ++row) {
      Eigen::Vector3d position;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.length_type) {
          read_list(element, row, property);
          if (i == columns.corners) add_corners(element, row, columns.is_strip, vertex_count);
          continue;
        }
        const double number = take(element, row, property.type);
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (columns.axes[axis] == i) position[static_cast<Eigen::Index>(axis)] = number;
      }
      if (element.name == "vertex") surface_.positions.push_back(position);
    }
  }

  void read_list(const PlyElement& element, std::uint64_t row, const PlyProperty& property) {
    const double length = take(element, row, *property.length_type);
    if (!(length >= 0) || length != std::floor(length))
      fail_row(element, row, "a list has no proper length; correct it");
    list_.clear();
    for (std::uint64_t i = 0; static_cast<double>(i) < length; ++i)
      list_.push_back(take(element, row, property.type));
  }

  double take(const PlyElement& element, std::uint64_t row, PlyType type) {
    const auto number = numbers_.next(type);
    if (!number) fail_row(element, row, "the file ends here, or a word is no number; write the file again");
    return *number;
  }

  void add_corners(const PlyElement& element, std::uint64_t row, bool is_strip, std::uint64_t vertex_count) {
    face_.clear();
    for (const double number : list_) {
      if (is_strip && number == -1) {
        add_strip();
        continue;
      }
      if (!(number >= 0 && number < static_cast<double>(vertex_count)) || number != std::floor(number))
        fail_row(element, row,
                 joined("a face names vertex ", integer_text(number), " of ", vertex_count,
                        " (counted from 0); remove the face or add the vertex"));
      face_.push_back(static_cast<std::uint32_t>(number));
    }
    if (is_strip)
      add_strip();
    else if (face_.size() < 3)
      ++small_faces_;
    else
      surface_.add_face(face_);
  }

  /// Every corner from the third on makes a triangle with the two before it. Every other one is turned round.
  void add_strip() {
    for (std::size_t i = 2; i < face_.size(); ++i) {
      const bool is_turned = i % 2 == 1;
      surface_.add_face(
          std::array{face_[is_turned ? i - 1 : i - 2], face_[is_turned ? i - 2 : i - 1], face_[i]});
    }
    face_.clear();
  }

  static std::string integer_text(double number) {
    return std::abs(number) < 1e15 && number == std::floor(number)
               ? std::to_string(static_cast<std::int64_t>(number))
               : std::to_string(number);
  }

  [[noreturn]] void fail_row(const PlyElement& element, std::uint64_t row, const std::string& what) const {
    fail(path_, joined(element.name, " ", row, " (counted from 0): ", what));
  }

  const std::filesystem::path& path_;
  PlyHeader header_;
  PlyNumbers numbers_;
  RawSurface surface_;
  std::vector<double> list_;
  std::vector<std::uint32_t> face_;
  std::size_t small_faces_ = 0;
};

}  // namespace

RawFile read_ply(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  return PlyReader(path, bytes).read();
}

std::uint64_t announced_ply_vertices(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path, header_bytes);
  return vertex_rows(read_ply_header(path, bytes));
}

}  // namespace graze::io
