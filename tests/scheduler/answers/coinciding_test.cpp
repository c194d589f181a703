// Surfaces that coincide exactly, in every detail: the reports are those of a scene built afresh in each
// frame.

#include <graze/graze.hpp>
#include <limits>
#include <string_view>

#include "scenes/coinciding_scenes.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t frames = 3;

SceneSettings settings_of(const scenes::PlayedScene& played, ContactDetail detail, unsigned threads) {
  SceneSettings settings = played.settings();
  settings.detail = detail;
  settings.threads = threads;
  return settings;
}

/// The report of a scene that steps for the first time in a frame.
ReportHandle built_afresh(std::string_view name, ContactDetail detail, std::size_t last) {
  const auto played = scenes::make_coinciding_scene(name);
  Scene scene(settings_of(*played, detail, 1));
  for (std::size_t frame = 0; frame <= last; ++frame) played->advance(scene, frame);
  return scene.step();
}

}  // namespace

TEST_CASE("coinciding surfaces: reports equal those of a scene built afresh in each frame") {
  for (const std::string_view name :
       {"layers_on", "wall_touching", "twins_on", "boxes_flush", "boxes_apart", "character"})
    for (const ContactDetail detail : all_details) {
      const auto played = scenes::make_coinciding_scene(name);
      const SceneSettings settings = settings_of(*played, detail, 2);
      Scene scene(settings);
      for (std::size_t frame = 0; frame < frames; ++frame) {
        INFO(name << ", detail " << static_cast<int>(detail) << ", frame " << frame);
        played->advance(scene, frame);
        const ReportHandle report = scene.step();
        const ReportHandle afresh = built_afresh(name, detail, frame);
        const double reach = std::max(settings.range, settings.contact_distance);
        REQUIRE(timeless_rows_of(*report, reach) == timeless_rows_of(*afresh, reach));
        CHECK((frame > 0 || !report->pairs().empty() || settings.contact_distance == 0));
      }
    }
}

TEST_CASE("coinciding surfaces: there is a scene of each name") {
  for (const std::string_view name : scenes::coinciding_scene_names())
    CHECK(scenes::make_coinciding_scene(name) != nullptr);
  CHECK(scenes::make_coinciding_scene("none of these") == nullptr);
}

}  // namespace graze::tests
