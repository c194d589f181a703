#include "export/output_file.hpp"

#include "text/file_bytes.hpp"

namespace graze::io {

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path.string()), stream_(path, std::ios::binary) {
  if (!stream_) fail(path_, "cannot be written; check that its folder exists and may be written to");
}

void OutputFile::write(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  check();
}

void OutputFile::close() {
  stream_.close();
  check();
}

void OutputFile::check() {
  if (!stream_) fail(path_, "cannot be written further; free some space or choose another place");
}

}  // namespace graze::io
