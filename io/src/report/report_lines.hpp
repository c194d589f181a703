#pragma once

#include <zlib.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace graze::io {

/// Writes the lines of a report. The file is compressed as gzip does it if its name ends in `.gz`. Equal
/// lines make equal files.
class ReportLinesOut {
 public:
  /// Opens the file and empties it. Throws InputError where it cannot be written.
  explicit ReportLinesOut(const std::filesystem::path& path);

  /// Throws InputError if the disk takes no more.
  void write(std::string_view line);
  /// Throws InputError if not all of it arrived on the disk.
  void close();

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose(file); }
  };

  std::string path_;
  std::unique_ptr<gzFile_s, Close> file_;
};

/// Reads the lines of a report. A file that gzip compressed is known by its first bytes, whatever its name
/// is.
class ReportLinesIn {
 public:
  /// Throws InputError where the file cannot be read.
  explicit ReportLinesIn(const std::filesystem::path& path);

  /// Reads the next line, without its end. Returns false at the end of the file. Throws InputError for a file
  /// that is damaged or cut off, and for a compressed line that becomes longer than 1 GiB.
  bool next(std::string& line);

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose(file); }
  };

  bool fill();

  std::string path_;
  std::unique_ptr<gzFile_s, Close> file_;
  std::string bytes_;      ///< unpacked
  std::size_t begin_ = 0;  ///< of what `next` has not given yet
};

}  // namespace graze::io
