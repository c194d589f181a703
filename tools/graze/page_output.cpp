#include "page_output.hpp"

#include <algorithm>
#include <cstdio>
#include <graze/io/error.hpp>
#include <graze/settings_fields.hpp>

#include "output/terminal.hpp"
#include "output/text.hpp"
#include "output_path.hpp"
#include "viewer/viewer_page.hpp"

namespace graze::tools {
namespace {

namespace fs = std::filesystem;

std::string megabytes(std::uint64_t bytes) {
  return fixed(static_cast<double>(bytes) / 1e6, 1) + " MB";
}

std::string ordinal(std::uint32_t number) {
  const std::uint32_t ten = number % 100 / 10;
  const std::uint32_t one = number % 10;
  const char* const ending = ten == 1 ? "th" : one == 1 ? "st" : one == 2 ? "nd" : one == 3 ? "rd" : "th";
  return std::to_string(number) + ending;
}

io::PageOptions page_options(const fs::path& path, const SceneSettings& settings, std::size_t frame_count,
                             const PageOutput::Options& options) {
  io::PageOptions page;
  page.title = options.title;
  page.source = options.source;
  page.settings = settings;
  page.every = options.every.value_or(1);
  page.expected_frames = frame_count;
  page.include_times = options.include_times;
  if (!options.every && !is_page_data(path)) page.max_bytes = most_page_bytes;
  return page;
}

void check_page_file(const std::string& option, const fs::path& file) {
  check_output_file(option, file);
  if (is_page_data(file)) return;
  if (file.extension() != ".html" && file.extension() != ".htm")
    throw io::InputError(option + ": " + file.string() +
                         " cannot be written: end it in .html for a page, or in .grazeview for its data");
  if (!has_viewer()) viewer_page();  // its error says how to get one
}

}  // namespace

bool is_page_data(const fs::path& file) {
  return file.extension() == ".grazeview";
}

void add_page(OutputFiles& outputs, const std::string& option, const fs::path& file) {
  check_page_file(option, file);
  outputs.add_growing(option, file);
}

io::PageObject page_object(const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                           const ObjectSettings& settings) {
  static_assert(
      are_all_fields<ObjectSettings, &ObjectSettings::name, &ObjectSettings::motion,
                     &ObjectSettings::user_data, &ObjectSettings::solid, &ObjectSettings::swept,
                     // The rest of the settings says what is tested. A page needs that where it computes.
                     &ObjectSettings::layer, &ObjectSettings::collides_with, &ObjectSettings::group,
                     &ObjectSettings::margin, &ObjectSettings::kind, &ObjectSettings::face_groups,
                     &ObjectSettings::hidden_groups, &ObjectSettings::self, &ObjectSettings::self_rings,
                     &ObjectSettings::self_at_rest,
                     // These are for answers between steps.
                     &ObjectSettings::queries, &ObjectSettings::patch_radius, &ObjectSettings::patch_faces>(),
      "each field of ObjectSettings is in pages, or is named as one that is not");
  return {name, mesh, settings.motion, settings.user_data, settings.solid, settings.swept, settings};
}

PageOutput::PageOutput(const fs::path& path, const SceneSettings& settings, std::size_t frame_count,
                       const Options& options)
    : path_(path),
      options_(options),
      frame_count_(frame_count),
      writer_(path, is_page_data(path) ? std::string() : viewer_page(),
              page_options(path, settings, frame_count, options)) {}

void PageOutput::frame(std::uint64_t number, const FrameReport& report) {
  writer_.frame(number, report);
  warn_of_size();
}

void PageOutput::warn_of_size() {
  if (has_warned_ || writer_.estimated_bytes() <= most_page_bytes) return;
  has_warned_ = true;
  std::string text =
      options_.option + ": " + path_.string() + " would have about " + megabytes(writer_.estimated_bytes());
  if (writer_.every() > options_.every.value_or(1))
    text += "; it gets every " + ordinal(writer_.every()) + " frame, so that it stays below " +
            megabytes(most_page_bytes) + " (--html-every 1, or a file that ends in .grazeview, has all)";
  else
    text += "; --html-every K writes each K-th frame";
  say_aside("note", text);
}

std::string PageOutput::close() {
  const std::uint64_t frames = writer_.frame_count();
  writer_.close();
  std::string text = path_.string() + ", ";
  if (writer_.every() > 1) text += "every " + ordinal(writer_.every()) + " frame, ";
  return text + std::to_string(frames) + " of " + std::to_string(frame_count_) + " frames, " +
         megabytes(writer_.byte_count());
}

PlayedPage::PlayedPage(const fs::path& path, io::Player& player, const SceneSettings& settings,
                       const PageOutput::Options& options)
    : page_(path, settings, player.frame_count(), options) {
  for (const io::SceneObject& object : player.objects()) {
    const ObjectSettings known = player.scene().object_settings(object.id);
    page_.writer().add_object(object.id, page_object(object.name, object.mesh, known));
    is_deformable_.push_back(known.motion == Motion::deformable);
  }
  page_.writer().set_pair_filters(player.pair_filters());
}

void PlayedPage::add(std::uint32_t frame, const io::Player& player, const FrameReport& report) {
  if (page_.writer().takes_next_frame())
    for (std::size_t i = 0; i < is_deformable_.size(); ++i) {
      const ObjectId id = player.objects()[i].id;
      if (is_deformable_[i]) {
        player.read_positions(i, positions_);
        page_.writer().set_positions(id, positions_);
      } else {
        page_.writer().set_pose(id, player.pose(i));
      }
    }
  page_.frame(frame, report);
}

}  // namespace graze::tools
