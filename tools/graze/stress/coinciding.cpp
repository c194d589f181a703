#include "stress/coinciding.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "scenes/coinciding_scenes.hpp"
#include "stress/details.hpp"

namespace graze::tools {
namespace {

/// A scene, and its neighbour where it has one.
struct Couple {
  std::string_view scene;
  std::string_view neighbour;
};
constexpr std::array<Couple, 7> couples = {{{"layers_on", "layers_off"},
                                            {"wall_touching", "wall_turned"},
                                            {"twins_on", "twins_off"},
                                            {"spheres_on", "spheres_off"},
                                            {"boxes_flush", "boxes_apart"},
                                            {"copies", ""},
                                            {"character", ""}}};

struct Timed {
  double median_ms = 0;
  std::size_t contacts = 0;  ///< of the last step
};

Timed time_of(std::string_view name, ContactDetail detail, std::size_t frames) {
  const auto played = scenes::make_coinciding_scene(name);
  SceneSettings settings = played->settings();
  settings.detail = detail;
  settings.threads = 1;
  Scene scene(settings);
  std::vector<double> times;
  Timed result;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    played->advance(scene, frame);
    const ReportHandle report = scene.step();
    times.push_back(report->statistics().step_ms);
    result.contacts = report->contacts().size();
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  result.median_ms = *middle;
  return result;
}

}  // namespace

StressResult run_coinciding_study(std::size_t frames) {
  StressResult result;
  result.figures = {{"frames", frames}};
  std::printf("%-14s %-9s %10s %9s   %-12s %10s %9s %6s\n", "scene", "detail", "ms a step", "contacts",
              "neighbour", "ms a step", "contacts", "ratio");
  for (const Couple& couple : couples)
    for (const NamedDetail& detail : timed_details) {
      const Timed on = time_of(couple.scene, detail.detail, frames);
      std::printf("%-14s %-9s %10.3f %9zu", couple.scene.data(), detail.name, on.median_ms, on.contacts);
      auto& figures = result.figures["scenes"].emplace_back();
      figures = {
          {"scene", couple.scene}, {"detail", detail.name}, {"ms", on.median_ms}, {"contacts", on.contacts}};
      if (!couple.neighbour.empty()) {
        const Timed off = time_of(couple.neighbour, detail.detail, frames);
        std::printf("   %-12s %10.3f %9zu %6.2f", couple.neighbour.data(), off.median_ms, off.contacts,
                    on.median_ms / off.median_ms);
        figures["neighbour"] = {
            {"scene", couple.neighbour}, {"ms", off.median_ms}, {"contacts", off.contacts}};
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  return result;
}

}  // namespace graze::tools
