#include "file_bytes.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <graze/io/error.hpp>

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
  std::ifstream stream(path, std::ios::binary);
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

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace graze::io
