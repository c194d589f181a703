#include "assimp/assimp_files.hpp"

#include <utility>

#include "text/opened_files.hpp"

namespace graze::io {

AssimpFiles::AssimpFiles(std::filesystem::path mesh_file, const ReadOptions& options)
    : mesh_file_(std::move(mesh_file)), options_(options) {}

bool AssimpFiles::is_allowed(const std::filesystem::path& file) const {
  if (options_.outside_files || file == mesh_file_ || is_in_folder_of(mesh_file_, file)) return true;
  std::error_code error;
  return std::filesystem::equivalent(file, mesh_file_, error);
}

bool AssimpFiles::Exists(const char* file) const {
  if (!DefaultIOSystem::Exists(file)) return false;
  if (is_allowed(file)) return true;
  refused_.insert(file);
  return false;
}

Assimp::IOStream* AssimpFiles::Open(const char* file, const char* mode) {
  if (!Exists(file)) return nullptr;
  OpenedFiles::add(file);
  return DefaultIOSystem::Open(file, mode);
}

}  // namespace graze::io
