#pragma once

#include <cstdint>
#include <filesystem>
#include <graze/io/page.hpp>
#include <graze/io/player.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output_files.hpp"

namespace graze::tools {

/// A page is made smaller than this, unless the user says how many frames it has.
inline constexpr std::uint64_t most_page_bytes = 100'000'000;

/// Adds a page or its data to a command's files. Throws io::InputError where it cannot be written, also since
/// its ending is none that pages have, or since the program was built without the viewer.
void add_page(OutputFiles& outputs, const std::string& option, const std::filesystem::path& file);

/// Whether a file has a page's data alone, by its ending.
bool is_page_data(const std::filesystem::path& file);

/// What a page shows of an object with these settings.
io::PageObject page_object(const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                           const ObjectSettings& settings);

/// Writes a page, and says in time that it would become large.
class PageOutput {
 public:
  struct Options {
    std::string option;  ///< how messages name it
    std::string title;
    std::string source;
    std::optional<std::uint32_t> every;  ///< no value: each frame, or as many as keep the page small
    bool include_times = true;
  };

  PageOutput(const std::filesystem::path& path, const SceneSettings& settings, std::size_t frame_count,
             const Options& options);

  /// The writer, for objects and where they are.
  [[nodiscard]] io::PageWriter& writer() { return writer_; }
  /// Takes a frame.
  void frame(std::uint64_t number, const FrameReport& report);
  /// Ends the page, and gives a line for the summary.
  std::string close();

 private:
  void warn_of_size();

  std::filesystem::path path_;
  Options options_;
  std::size_t frame_count_;
  io::PageWriter writer_;
  bool has_warned_ = false;
};

/// Writes what a player plays into a page.
class PlayedPage {
 public:
  PlayedPage(const std::filesystem::path& path, io::Player& player, const SceneSettings& settings,
             const PageOutput::Options& options);

  /// Takes a frame that was played.
  void add(std::uint32_t frame, const io::Player& player, const FrameReport& report);
  /// Ends the page, and gives a line for the summary.
  std::string close() { return page_.close(); }

 private:
  PageOutput page_;
  std::vector<bool> is_deformable_;  ///< by object
  std::vector<Eigen::Vector3d> positions_;
};

}  // namespace graze::tools
