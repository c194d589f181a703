#include "stress/neighbours/coinciding.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/coinciding_scenes.hpp"
#include "stress/details.hpp"
#include "stress/median.hpp"

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
    times.push_back(report->statistics().times.step_ms);
    result.contacts = report->contacts().size();
  }
  result.median_ms = median_of(times);
  return result;
}

}  // namespace

StressResult run_coinciding_study(std::size_t frames) {
  StressResult result;
  result.figures = {{"frames", frames}};
  const TextTable table({{"scene", 14, Align::left},
                         {"detail", 9, Align::left},
                         {"ms a step", 10},
                         {"contacts", 9},
                         {"neighbour", 12, Align::left},
                         {"ms a step", 10},
                         {"contacts", 9},
                         {"ratio", 6}});
  print(table.head());
  for (const Couple& couple : couples)
    for (const NamedDetail& detail : timed_details) {
      const Timed on = time_of(couple.scene, detail.detail, frames);
      std::vector<std::string> cells = {std::string(couple.scene), detail.name, fixed(on.median_ms, 3),
                                        std::to_string(on.contacts)};
      auto& figures = result.figures["scenes"].emplace_back();
      figures = {
          {"scene", couple.scene}, {"detail", detail.name}, {"ms", on.median_ms}, {"contacts", on.contacts}};
      if (!couple.neighbour.empty()) {
        const Timed off = time_of(couple.neighbour, detail.detail, frames);
        cells.insert(cells.end(), {std::string(couple.neighbour), fixed(off.median_ms, 3),
                                   std::to_string(off.contacts), fixed(on.median_ms / off.median_ms, 2)});
        figures["neighbour"] = {
            {"scene", couple.neighbour}, {"ms", off.median_ms}, {"contacts", off.contacts}};
      }
      print(table.row(cells));
    }
  return result;
}

}  // namespace graze::tools
