#include "formats/ply_header.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/raw_object.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

std::optional<PlyType> ply_type(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> names = {{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  for (const auto& [word, type] : names)
    if (word == name) return type;
  return std::nullopt;
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes), lines_(bytes) {}

  /// Comments and what else is not known are passed over.
  PlyHeader read() {
    if (trimmed(lines_.next()) != "ply") fail_line("the file does not start with 'ply'; it is no PLY file");
    while (!lines_.at_end()) {
      std::string_view rest = lines_.next();
      const std::string_view keyword = next_word(rest);
      if (keyword == "end_header") return finished();
      if (keyword == "format")
        read_format(rest);
      else if (keyword == "element")
        read_element(rest);
      else if (keyword == "property")
        read_property(rest);
    }
    fail_line("the header has no end_header; write the file again");
  }

 private:
  void read_format(std::string_view rest) {
    const std::string_view name = next_word(rest);
    if (name == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (name == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (name == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      fail_line(joined("format '", name, "' is unknown; save the file as ascii or binary_little_endian"));
    has_format_ = true;
  }

  void read_element(std::string_view rest) {
    PlyElement element;
    element.name = next_word(rest);
    const auto count = parse_number<std::uint64_t>(next_word(rest));
    if (!count) fail_line("an element needs a name and a count; correct the line");
    if (*count >= Mesh::no_edge) fail_line("the element has 2^32 rows or more; split the mesh");
    element.row_count = *count;
    header_.elements.push_back(std::move(element));
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) fail_line("a property comes before any element; correct the header");
    PlyProperty property;
    std::string_view type = next_word(rest);
    if (type == "list") {
      property.length_type = type_named(next_word(rest));
      type = next_word(rest);
    }
    property.type = type_named(type);
    property.name = next_word(rest);
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[nodiscard]] PlyType type_named(std::string_view name) const {
    const auto type = ply_type(name);
    if (!type) fail_line(joined("'", name, "' is no PLY type; correct the line"));
    return *type;
  }

  PlyHeader finished() {
    if (!has_format_) fail_line("the header has no format line; add one");
    const auto vertices = std::ranges::count(header_.elements, "vertex", &PlyElement::name);
    if (vertices == 0) fail(path_, "header: there is no element 'vertex'; add the vertices");
    if (vertices > 1) fail(path_, "header: element 'vertex' stands twice; join the two");
    header_.body_begin = bytes_.size() - lines_.rest().size();
    return std::move(header_);
  }

  [[noreturn]] void fail_line(const std::string& what) const { fail(path_, lines_.line(), what); }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  TextLines lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes) {
  return PlyHeaderReader(path, bytes).read();
}

}  // namespace graze::io
