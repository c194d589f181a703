#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <set>
#include <string>

namespace graze::io {

/// Opens files for assimp: the mesh file, and those that it names. Files outside its folder are refused, as
/// `options` says.
class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  AssimpFiles(std::filesystem::path mesh_file, const ReadOptions& options);

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  /// The files that are there, and were refused.
  [[nodiscard]] const std::set<std::string>& refused() const { return refused_; }

 private:
  [[nodiscard]] bool is_allowed(const std::filesystem::path& file) const;

  std::filesystem::path mesh_file_;
  ReadOptions options_;
  mutable std::set<std::string> refused_;
};

}  // namespace graze::io
