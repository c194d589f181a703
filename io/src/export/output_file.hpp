#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace graze::io {

/// A file that an export writes. What the disk does not take is an InputError with the path.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);

  void write(std::string_view bytes);
  void close();

 private:
  void check();

  std::string path_;
  std::ofstream stream_;
};

}  // namespace graze::io
