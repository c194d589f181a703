#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace graze::tools {

/// The files that a command writes. A command adds all of them, and checks them against the files that it
/// reads, before it writes the first. Every refusal is an io::InputError.
///
/// Two names are one file if they are equal after links are followed, or if they are hard links. Devices such
/// as /dev/null may be written by several options.
class OutputFiles {
 public:
  /// Adds the file of an option. Throws where it cannot be written, where another option has it, and where
  /// standard output goes into it.
  void add(const std::string& option, const std::filesystem::path& file);

  /// Adds a picture, whose name must end in .png.
  void add_picture(const std::string& option, const std::filesystem::path& file);

  /// Adds a file, and the file that it is until it is whole.
  void add_growing(const std::string& option, const std::filesystem::path& file);

  /// Adds the .vtp files of a time series, which need not be there yet. All of its folder's count.
  void add_series(const std::string& option, const std::filesystem::path& folder);

  /// Throws where a file that the command reads is one of those that it writes.
  void check_inputs(std::span<const std::filesystem::path> inputs) const;

 private:
  struct Output {
    std::string option;
    std::filesystem::path file;
    bool is_series = false;  ///< all .vtp files of the folder `file`
  };

  static bool is_written_by(const Output& output, const std::filesystem::path& file);
  void add_unique(Output output);

  std::vector<Output> outputs_;
};

}  // namespace graze::tools
