#include "text/file_bytes.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <graze/io/error.hpp>

#include "text/opened_files.hpp"

namespace graze::io {

void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(joined(path.string(), ": ", what));
}

void fail(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  fail(path, joined("line ", line, ": ", what));
}

void require_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail(path, "there is no such file; check the path");
  if (std::filesystem::is_directory(status)) fail(path, "this is a folder; name a file in it");
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size == 0) fail(path, "the file is empty; write it again");
}

std::string read_bytes(const std::filesystem::path& path, std::size_t limit) {
  require_file(path);
  std::ifstream stream = open_input(path);
  if (!stream) fail(path, "the file cannot be opened; check its permissions");
  std::string bytes;
  std::array<char, 65536> chunk;
  while (bytes.size() < limit) {
    const std::size_t wanted = std::min(chunk.size(), limit - bytes.size());
    stream.read(chunk.data(), static_cast<std::streamsize>(wanted));
    if (stream.gcount() == 0) break;
    bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) fail(path, "reading the file failed; check the disk");
  return bytes;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::uint32_t word_at(std::string_view bytes, std::size_t offset, bool is_big_endian) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word = (word << 8U) | static_cast<unsigned char>(bytes[offset + (is_big_endian ? i : 3 - i)]);
  return word;
}

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace graze::io
