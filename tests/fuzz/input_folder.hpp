#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "tools/temporary_folder.hpp"

namespace graze::fuzz {

/// The folder into which a fuzzer writes its input for readers that take a path. Each process has a folder of
/// its own in TMPDIR, which is best on a memory disk.
inline const tests::TemporaryFolder& input_folder() {
  static const tests::TemporaryFolder folder;
  return folder;
}

inline std::filesystem::path write_input(const std::string& name, std::span<const std::uint8_t> bytes) {
  std::filesystem::path path = input_folder() / name;
  std::ofstream stream(path, std::ios::binary);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes to a stream of char
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return path;
}

}  // namespace graze::fuzz
