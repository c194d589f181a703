#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

namespace graze::io {

/// Collects the names of all files that graze::io reads on this thread while it lives. So no reader can
/// forget to say what it read. Such lists nest: when an inner one ends, the outer one has its files too.
class OpenedFiles {
 public:
  OpenedFiles();
  ~OpenedFiles();
  OpenedFiles(const OpenedFiles&) = delete;
  OpenedFiles& operator=(const OpenedFiles&) = delete;

  [[nodiscard]] const std::set<std::filesystem::path>& paths() const { return paths_; }

  /// Adds a file to the innermost list of this thread, if there is one.
  static void add(const std::filesystem::path& path);

 private:
  std::set<std::filesystem::path> paths_;
  OpenedFiles* outer_;
};

/// Opens a file to be read, and adds it to the list of opened files. All readers open their files by it.
std::ifstream open_input(const std::filesystem::path& path);

/// Whether `named` is in the folder of the file `naming`, or in a folder below. Links count as what they lead
/// to. A file that is not there may be asked for too.
bool is_in_folder_of(const std::filesystem::path& naming, const std::filesystem::path& named);

/// What to do where a mesh file names a file outside its folder.
inline constexpr std::string_view outside_remedy =
    "put it there, or, if you trust this file, allow it with --outside-files, or with \"outside_files\": "
    "true "
    "in a scene file";

}  // namespace graze::io
