#include "page/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>

namespace graze::io {
namespace {

constexpr int gzip_window_bits = 15 + 16;  // the largest window; 16 asks for a header of gzip
constexpr int gzip_memory_level = 8;

/// zlib counts bytes in 32 bits.
uInt bytes_at_once(std::size_t bytes) {
  return static_cast<uInt>(std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max()));
}

}  // namespace

std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window_bits, gzip_memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed;
  try {
    packed.resize(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  } catch (...) {
    deflateEnd(&stream);
    throw;
  }
  std::size_t read = 0;
  std::size_t written = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    const uInt in = bytes_at_once(bytes.size() - read);
    const uInt out = bytes_at_once(packed.size() - written);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + read));  // zlib only reads it
    stream.avail_in = in;
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + written);
    stream.avail_out = out;
    state = deflate(&stream, read + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    read += in - stream.avail_in;
    written += out - stream.avail_out;
  }
  deflateEnd(&stream);
  packed.resize(written);
  return packed;
}

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text(4 * ((bytes.size() + 2) / 3), '=');
  char* next = text.data();
  for (std::size_t begin = 0; begin < bytes.size(); begin += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - begin);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8U | (i < count ? static_cast<unsigned char>(bytes[begin + i]) : 0U);
    for (std::size_t i = 0; i <= count; ++i) next[i] = digits[bits >> (18 - 6 * i) & 63U];
    next += 4;
  }
  return text;
}

}  // namespace graze::io
