// A 3MF file is a ZIP archive. assimp has a reader of archives, which it does not export.

#include "assimp/threemf_frame.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

constexpr std::size_t end_record_bytes = 22;
constexpr std::size_t entry_bytes = 46;
constexpr std::size_t local_header_bytes = 30;

std::size_t short_at(std::string_view bytes, std::size_t offset) {
  return static_cast<unsigned char>(bytes[offset]) +
         std::size_t{256} * static_cast<unsigned char>(bytes[offset + 1]);
}

/// One file of an archive, as it is packed.
struct Packed {
  std::string_view bytes;
  bool is_deflated = false;
};

/// The bytes behind a local header, as far as they are there.
std::optional<Packed> packed_at(std::string_view archive, std::size_t offset, std::size_t size,
                                std::size_t method) {
  if (offset + local_header_bytes > archive.size() || !archive.substr(offset).starts_with("PK\x03\x04"))
    return std::nullopt;
  const std::size_t begin =
      offset + local_header_bytes + short_at(archive, offset + 26) + short_at(archive, offset + 28);
  if (begin > archive.size() || (method != 0 && method != Z_DEFLATED)) return std::nullopt;
  return Packed{archive.substr(begin, size), method == Z_DEFLATED};
}

/// The model of an archive: the file that ends in `.model` and stands in the folder 3D.
std::optional<Packed> find_model(std::string_view archive) {
  const std::size_t end = archive.rfind("PK\x05\x06");
  if (end == std::string_view::npos || archive.size() - end < end_record_bytes) return std::nullopt;
  std::size_t entry = word_at(archive, end + 16);
  while (entry + entry_bytes <= archive.size() && archive.substr(entry).starts_with("PK\x01\x02")) {
    const std::size_t name_size = short_at(archive, entry + 28);
    const std::string name = lower_case(archive.substr(entry + entry_bytes, name_size));
    if (name.starts_with("3d/") && name.ends_with(".model"))
      return packed_at(archive, word_at(archive, entry + 42), word_at(archive, entry + 20),
                       short_at(archive, entry + 10));
    entry += entry_bytes + name_size + short_at(archive, entry + 30) + short_at(archive, entry + 32);
  }
  return std::nullopt;
}

/// The first bytes of a packed file.
std::string beginning_of(const Packed& packed) {
  if (!packed.is_deflated) return std::string(packed.bytes.substr(0, header_bytes));
  std::string text(header_bytes, '\0');
  std::string input(packed.bytes.substr(0, header_bytes));
  z_stream stream{};
  constexpr int raw_deflate = -15;
  if (inflateInit2(&stream, raw_deflate) != Z_OK) return "";
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  inflate(&stream, Z_SYNC_FLUSH);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

/// Metres in one unit. No value where the text has no model.
std::optional<double> unit_in(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units = {{{"micron", 1e-6},
                                                                         {"millimeter", 0.001},
                                                                         {"centimeter", 0.01},
                                                                         {"inch", 0.0254},
                                                                         {"foot", 0.3048},
                                                                         {"meter", 1}}};
  const std::size_t model = text.find("<model");
  if (model == std::string::npos) return std::nullopt;
  const std::string tag = text.substr(model, text.find('>', model) - model);
  std::string word = "millimeter";
  for (const char quote : {'"', '\''}) {
    const std::size_t key = tag.find(std::string(" unit=") + quote);
    if (key != std::string::npos) word = tag.substr(key + 7, tag.find(quote, key + 7) - key - 7);
  }
  const auto* const unit = std::ranges::find(units, word, &std::pair<std::string_view, double>::first);
  return unit == units.end() ? std::nullopt : std::optional(unit->second);
}

}  // namespace

FileFrame read_threemf_frame(const std::filesystem::path& path) {
  FileFrame frame;
  const std::string archive = read_bytes(path);
  const auto model = find_model(archive);
  if (!model) return frame;
  frame.metres_per_unit = unit_in(beginning_of(*model));
  frame.up = "z";
  return frame;
}

}  // namespace graze::io
