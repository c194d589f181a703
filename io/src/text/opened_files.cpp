#include "text/opened_files.hpp"

#include <algorithm>

namespace graze::io {
namespace {

thread_local OpenedFiles* innermost = nullptr;

}  // namespace

OpenedFiles::OpenedFiles() : outer_(innermost) {
  innermost = this;
}

OpenedFiles::~OpenedFiles() {
  innermost = outer_;
  if (outer_ != nullptr) outer_->paths_.merge(paths_);
}

void OpenedFiles::add(const std::filesystem::path& path) {
  if (innermost != nullptr) innermost->paths_.insert(path);
}

std::ifstream open_input(const std::filesystem::path& path) {
  OpenedFiles::add(path);
  return std::ifstream(path, std::ios::binary);
}

bool is_in_folder_of(const std::filesystem::path& naming, const std::filesystem::path& named) {
  std::error_code error;
  const auto folder =
      std::filesystem::weakly_canonical(std::filesystem::absolute(naming).parent_path(), error);
  if (error) return false;
  const auto target = std::filesystem::weakly_canonical(std::filesystem::absolute(named), error);
  return !error &&
         std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first == folder.end();
}

}  // namespace graze::io
