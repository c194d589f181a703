#include "report/report_lines.hpp"

#include <graze/io/error.hpp>

#include "text/file_bytes.hpp"
#include "text/opened_files.hpp"

namespace graze::io {
namespace {

/// A report of many contacts compresses to about half, whatever the level. The first one is the fastest by
/// far.
constexpr const char* compressed = "wb1";
constexpr const char* as_it_is = "wbT";

constexpr unsigned buffer_bytes = 1U << 17U;
constexpr std::size_t longest_line = std::size_t{1} << 30U;

}  // namespace

ReportLinesOut::ReportLinesOut(const std::filesystem::path& path)
    : path_(path.string()),
      file_(gzopen(path.c_str(), lower_extension(path) == ".gz" ? compressed : as_it_is)) {
  if (!file_) fail(path, "cannot be written; check that its folder exists and may be written to");
  gzbuffer(file_.get(), buffer_bytes);
}

void ReportLinesOut::write(std::string_view line) {
  const bool is_written =
      gzfwrite(line.data(), 1, line.size(), file_.get()) == line.size() && gzputc(file_.get(), '\n') == '\n';
  if (!is_written) fail(path_, "cannot be written further; free some space or choose another place");
}

void ReportLinesOut::close() {
  if (gzclose(file_.release()) != Z_OK) fail(path_, "did not reach the disk whole; free some space");
}

ReportLinesIn::ReportLinesIn(const std::filesystem::path& path)
    : path_(path.string()), file_(gzopen(path.c_str(), "rb")) {
  OpenedFiles::add(path);
  if (!file_) fail(path, "cannot be opened; check that the file exists and may be read");
  gzbuffer(file_.get(), buffer_bytes);
}

/// Unpacks more bytes behind those that are there. Returns false at the end of the file.
bool ReportLinesIn::fill() {
  bytes_.erase(0, begin_);
  begin_ = 0;
  if (bytes_.size() > longest_line && gzdirect(file_.get()) == 0)
    fail(path_, "a line becomes longer than 1 GiB; write the report with fewer contacts in a frame");
  const std::size_t size = bytes_.size();
  bytes_.resize(size + buffer_bytes);
  const int count = gzread(file_.get(), bytes_.data() + size, buffer_bytes);
  bytes_.resize(size + static_cast<std::size_t>(count > 0 ? count : 0));
  int problem = Z_OK;
  gzerror(file_.get(), &problem);
  if (count < 0 || problem == Z_BUF_ERROR)
    fail(path_, "is damaged or cut off, so that it cannot be unpacked; write the report again");
  return count > 0;
}

bool ReportLinesIn::next(std::string& line) {
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = bytes_.find('\n', begin_ + searched);
    if (end != std::string::npos) {
      line.assign(bytes_, begin_, end - begin_);
      begin_ = end + 1;
      return true;
    }
    searched = bytes_.size() - begin_;
    if (fill()) continue;
    line.assign(bytes_, begin_);
    begin_ = bytes_.size();
    return !line.empty();
  }
}

}  // namespace graze::io
