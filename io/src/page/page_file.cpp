#include "page/page_file.hpp"

#include <graze/io/error.hpp>
#include <graze/io/page.hpp>
#include <system_error>

#include "page/gzip.hpp"
#include "page/page_table.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

constexpr std::string_view data_file_begin = "GRZVIEW1";
constexpr std::string_view chunk_begin = "<script type=\"application/x-graze-chunk\" data-name=\"";
constexpr std::string_view chunk_middle = "\">";
constexpr std::string_view chunk_end = "</script>\n";

/// The file that a path leads to in the end, so that a link stays a link.
std::filesystem::path target_of(const std::filesystem::path& path) {
  std::error_code error;
  auto target = std::filesystem::weakly_canonical(path, error);
  return error || target.empty() ? path : target;
}

/// Whether a path names something that is no file, such as a pipe, which cannot be put into place afterwards.
bool is_no_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

PageFile::PageFile(const std::filesystem::path& path, std::string_view page_template)
    : path_(target_of(path)), part_(path_), is_page_(!page_template.empty()) {
  if (is_page_ && page_template.find(PageWriter::data_line) == std::string_view::npos)
    throw Error("page: the template has no line " + std::string(PageWriter::data_line) +
                "; give the viewer's built page");
  if (!is_no_file(path_)) part_ += ".part";
  stream_.open(part_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail(path_, "cannot be written; check that its folder exists and may be written to");
  try {
    begin(page_template);
  } catch (...) {
    remove_part();
    throw;
  }
}

PageFile::~PageFile() {
  if (stream_.is_open()) remove_part();
}

void PageFile::remove_part() {
  stream_.close();
  std::error_code ignored;
  if (part_ != path_) std::filesystem::remove(part_, ignored);
}

void PageFile::begin(std::string_view page_template) {
  if (!is_page_) {
    write_text(data_file_begin);
    return;
  }
  const std::size_t place = page_template.find(PageWriter::data_line);
  tail_ = page_template.substr(place + PageWriter::data_line.size());
  write_text(page_template.substr(0, place));
}

void PageFile::write_text(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_) fail(path_, "cannot be written further; free some space or choose another place");
  written_ += text.size();
}

void PageFile::write_chunk(std::string_view name, std::string_view packed) {
  if (is_page_) {
    write_text(joined(chunk_begin, name, chunk_middle));
    write_text(base64_of(packed));
    write_text(chunk_end);
    return;
  }
  std::string sizes;
  append_little_endian(sizes, static_cast<std::uint32_t>(name.size()));
  append_little_endian(sizes, std::uint64_t{packed.size()});
  write_text(joined(sizes, name));
  write_text(packed);
}

std::uint64_t PageFile::size_of_chunk(std::string_view name, std::size_t packed_bytes) const {
  if (!is_page_) return sizeof(std::uint32_t) + sizeof(std::uint64_t) + name.size() + packed_bytes;
  return chunk_begin.size() + name.size() + chunk_middle.size() + 4 * ((packed_bytes + 2) / 3) +
         chunk_end.size();
}

void PageFile::close() {
  write_text(tail_);
  tail_.clear();
  stream_.close();
  if (!stream_) {
    remove_part();
    fail(path_, "did not reach the disk whole; free some space");
  }
  if (part_ == path_) return;
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (!error) return;
  remove_part();
  fail(path_, "cannot be written: " + error.message());
}

}  // namespace graze::io
