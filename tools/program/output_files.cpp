#include "output_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <graze/io/error.hpp>
#include <utility>

#include "output_path.hpp"

namespace graze::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* series_ending = ".vtp";

/// The path of a file without links. The file need not be there, but its folder is.
fs::path target_of(const fs::path& file) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(file), ignored);
}

bool is_one_file(const fs::path& first, const fs::path& second) {
  std::error_code error;
  if (fs::is_character_file(first, error)) return false;
  if (fs::exists(first, error) && fs::exists(second, error)) return fs::equivalent(first, second, error);
  return target_of(first) == target_of(second);
}

bool is_standard_output(const fs::path& file) {
  struct stat output {};
  struct stat other {};
  return fstat(STDOUT_FILENO, &output) == 0 && S_ISREG(output.st_mode) && stat(file.c_str(), &other) == 0 &&
         output.st_dev == other.st_dev && output.st_ino == other.st_ino;
}

[[noreturn]] void refuse_output(const std::string& option, const fs::path& file, const std::string& why) {
  throw io::InputError(option + ": " + file.string() + " cannot be written: " + why + "; name another file");
}

}  // namespace

bool OutputFiles::is_written_by(const Output& output, const fs::path& file) {
  if (!output.is_series) return is_one_file(output.file, file);
  const fs::path folder = target_of(output.file);
  const fs::path target = target_of(file);
  if (target == folder || (file.extension() == series_ending && target.parent_path() == folder)) return true;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(output.file, ignored))
    if (entry.path().extension() == series_ending && is_one_file(entry.path(), file)) return true;
  return false;
}

void OutputFiles::add_unique(Output output) {
  if (!output.is_series && is_standard_output(output.file))
    refuse_output(output.option, output.file, "standard output goes into it");
  for (const Output& other : outputs_) {
    const bool is_other =
        output.is_series ? is_written_by(output, other.file) : is_written_by(other, output.file);
    if (is_other) refuse_output(output.option, output.file, "it is the file of " + other.option + " too");
  }
  outputs_.push_back(std::move(output));
}

void OutputFiles::add(const std::string& option, const fs::path& file) {
  check_output_file(option, file);
  add_unique({option, file});
}

void OutputFiles::add_picture(const std::string& option, const fs::path& file) {
  check_picture_file(option, file);
  add_unique({option, file});
}

void OutputFiles::add_growing(const std::string& option, const fs::path& file) {
  add(option, file);
  const fs::path target = target_of(file);
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) return;  // such as a pipe
  const fs::path part = fs::path(target) += ".part";
  check_output_file(option, part);
  add_unique({option, part});
}

void OutputFiles::add_series(const std::string& option, const fs::path& folder) {
  add_unique({option, folder, true});
}

void OutputFiles::check_inputs(std::span<const fs::path> inputs) const {
  std::error_code ignored;
  for (const Output& output : outputs_) {
    if (!fs::exists(output.file, ignored)) continue;
    for (const fs::path& input : inputs)
      if (is_written_by(output, input)) refuse_output(output.option, output.file, "it is what the run reads");
  }
}

}  // namespace graze::tools
