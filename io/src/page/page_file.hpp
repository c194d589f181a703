#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace graze::io {

/// The file of a page, or of its data alone: a sequence of named chunks. The file appears under its name when
/// it is closed.
class PageFile {
 public:
  /// An empty template gives a file of data alone. Throws InputError and Error as PageWriter's constructor.
  PageFile(const std::filesystem::path& path, std::string_view page_template);
  /// Removes what was written, unless it was closed.
  ~PageFile();
  PageFile(const PageFile&) = delete;
  PageFile& operator=(const PageFile&) = delete;

  /// Appends a chunk, whose bytes are as gzip writes them. Throws InputError if the disk takes no more.
  void write_chunk(std::string_view name, std::string_view packed);
  /// How many bytes of the file a chunk of so many bytes takes.
  [[nodiscard]] std::uint64_t size_of_chunk(std::string_view name, std::size_t packed_bytes) const;
  /// Writes what stands behind the data and gives the file its name. Throws InputError if not all of it
  /// arrived.
  void close();

  /// How many bytes the file has so far, with those that will stand behind the data.
  [[nodiscard]] std::uint64_t byte_count() const { return written_ + tail_.size(); }

 private:
  void write_text(std::string_view text);
  void begin(std::string_view page_template);
  void remove_part();

  std::filesystem::path path_;  ///< the file's name in the end
  std::filesystem::path part_;  ///< its name until then
  std::ofstream stream_;
  bool is_page_;
  std::string tail_;  ///< the template behind the data
  std::uint64_t written_ = 0;
};

}  // namespace graze::io
