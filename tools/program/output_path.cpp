#include "output_path.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <graze/io/error.hpp>

namespace graze::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& option, const fs::path& path, const std::string& why) {
  throw io::InputError(option + ": " + path.string() + " cannot be written: " + why);
}

/// Opens a file for writing and closes it; the number of what went wrong, or 0. What is made for that is
/// removed again.
int problem_of_writing(const fs::path& file) {
  int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool is_new = opened >= 0;
  if (!is_new && errno != EEXIST) return errno;
  if (!is_new) opened = open(file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return errno == ENXIO ? 0 : errno;  // a pipe that nobody reads yet
  close(opened);
  if (is_new) unlink(file.c_str());
  return 0;
}

}  // namespace

void check_output_file(const std::string& option, const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) refuse(option, file, "it is a folder; name a file in it");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    refuse(option, file,
           "there is no folder " + folder.string() + "; make it, or name a file in another one");
  if (const int problem = problem_of_writing(file)) refuse(option, file, std::strerror(problem));
}

void check_picture_file(const std::string& option, const fs::path& file) {
  check_output_file(option, file);
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  if (ending == ".png") return;
  refuse(option, file,
         (ending.empty() ? "it has no ending"
                         : "pictures of the format " + file.extension().string() + " are not made here") +
             "; end it in .png");
}

}  // namespace graze::tools
