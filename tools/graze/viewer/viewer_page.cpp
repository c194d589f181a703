#include "viewer/viewer_page.hpp"

#include <zlib.h>

#include <array>
#include <graze/io/error.hpp>

namespace graze::tools {
namespace {

constexpr int window_of_gzip = 15 + 16;

/// Unpacks all that there is. Stops where the bytes are no gzip.
std::string unpacked(z_stream& stream) {
  std::string text;
  std::array<char, 65536> part;
  for (int state = Z_OK; state == Z_OK;) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(part.data(), part.size() - stream.avail_out);
  }
  return text;
}

}  // namespace

bool has_viewer() {
  return !packed_viewer.empty();
}

std::string viewer_page() {
  return unpacked_viewer(packed_viewer);
}

std::string unpacked_viewer(std::span<const unsigned char> packed) {
  if (packed.empty())
    throw io::InputError(
        "this graze was built without the viewer; install nodejs and npm and build again, or write a file "
        "that ends in .grazeview");
  z_stream stream{};
  stream.next_in = const_cast<Bytef*>(packed.data());  // zlib only reads it
  stream.avail_in = static_cast<uInt>(packed.size());
  if (inflateInit2(&stream, window_of_gzip) != Z_OK) throw std::bad_alloc();
  std::string text = unpacked(stream);
  inflateEnd(&stream);
  return text;
}

}  // namespace graze::tools
