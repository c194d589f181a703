#pragma once

#include <array>
#include <cstdint>
#include <graze/io/page.hpp>
#include <graze/report.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "page/mesh_table.hpp"
#include "page/page_filters.hpp"
#include "text/json_text.hpp"

namespace graze::io {

/// The numbers of each frame of a page that the page shows before it decodes the frame.
class PageSeries {
 public:
  void add(const FrameReport& report, bool include_times);
  void write(JsonText& json) const;

 private:
  [[nodiscard]] bool has_impacts() const;

  static constexpr std::array<std::string_view, 12> count_names{
      "contacts", "near",         "in_contact", "began",    "ended",       "incomplete",
      "stale",    "contacts_cut", "inside",     "crossing", "diagnostics", "impacts"};

  std::array<std::vector<std::uint64_t>, count_names.size()> counts_;
  std::array<std::vector<double>, 6> times_;
  std::vector<std::optional<double>> deepest_;  ///< the smallest separation; no value without contacts
};

/// An object in the head. It exists in the page's frames `first` to `last`, or in none if last < first.
struct PageHeadObject {
  std::string name;
  Motion motion = Motion::deformable;
  bool solid = false;
  bool swept = false;
  ObjectSettings settings;
  std::size_t mesh = 0;
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::uint64_t user_data = 0;
  double position_error = 0;
};

/// Frames of the source that are missing before a frame of the page.
struct DroppedFrames {
  std::uint64_t before =
      0;  ///< the page's frame, or the number of its frames where they are missing at the end
  std::uint64_t count = 0;
};

/// All that stands in the chunk `head`.
struct PageHead {
  PageOptions options;  ///< `every` as it is in the end
  std::vector<std::uint64_t> frame_numbers;
  std::uint64_t source_frames = 0;
  std::uint64_t block = 1;
  std::vector<PageHeadObject> objects;
  std::vector<MeshCounts> meshes;
  PageSeries series;
  std::vector<std::uint64_t> diverged;
  std::vector<DroppedFrames> dropped;
  PageFilters filters;

  [[nodiscard]] std::string json() const;
};

/// The name of a numbered chunk, such as `mesh/0`.
std::string numbered_chunk(std::string_view kind, std::uint64_t number);

}  // namespace graze::io
