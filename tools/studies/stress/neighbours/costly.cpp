#include "stress/neighbours/costly.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/costly_scenes.hpp"
#include "stress/clocks.hpp"
#include "stress/details.hpp"
#include "stress/median.hpp"
#include "stress/neighbours/plain_loops.hpp"

namespace graze::tools {
namespace {

/// A scene, and its neighbour.
struct CostlyCouple {
  std::string_view scene;
  std::string_view neighbour;
};
constexpr std::array<CostlyCouple, 13> costly_couples = {{{"strips_straight", "cells"},
                                                          {"strips_turned", "strips_straight"},
                                                          {"strips_tilted", "strips_straight"},
                                                          {"zigzag_turned", "zigzag_straight"},
                                                          {"fan_of_hub", "strips_straight"},
                                                          {"fan_of_rim", "strips_straight"},
                                                          {"road", "strips_straight"},
                                                          {"cones_same", "cones_apart"},
                                                          {"cones_near", "cones_apart"},
                                                          {"crates_same", "crates_apart"},
                                                          {"crates_near", "crates_apart"},
                                                          {"balls_same", "balls_apart"},
                                                          {"balls_near", "balls_apart"}}};

struct StepTime {
  double median_ms = 0;
  std::size_t contacts = 0;  ///< of the step that had most
};

/// Leaves out the first frame, and frames in which two bodies in the same place are away from each other.
StepTime step_time_of(std::string_view name, ContactDetail detail, std::size_t frames) {
  const auto played = scenes::make_costly_scene(name);
  SceneSettings settings = played->settings();
  settings.detail = detail;
  settings.threads = 1;
  Scene scene(settings);
  std::vector<double> times;
  StepTime result;
  const std::size_t stride = name.ends_with("_same") ? 2 : 1;
  for (std::size_t frame = 0; frame <= stride * frames; ++frame) {
    played->advance(scene, frame);
    const double begin = cpu_ns(CLOCK_PROCESS_CPUTIME_ID);
    const ReportHandle report = scene.step();
    const double took = cpu_ns(CLOCK_PROCESS_CPUTIME_ID) - begin;
    if (frame == 0 || frame % stride != 0) continue;
    times.push_back(1e-6 * took);
    result.contacts = std::max(result.contacts, report->contacts().size());
  }
  result.median_ms = median_of(times);
  return result;
}

}  // namespace

StressResult run_costly_study(std::size_t frames) {
  StressResult result;
  result.figures = {{"frames", frames}};
  const TextTable table({{"scene", 15, Align::left},
                         {"detail", 9, Align::left},
                         {"ms a step", 10},
                         {"contacts", 9},
                         {"neighbour", 15, Align::left},
                         {"ms a step", 10},
                         {"ratio", 6},
                         {"plain loops", 11},
                         {"ratio", 6}});
  print(table.head());
  for (const CostlyCouple& couple : costly_couples) {
    const auto body = scenes::body_of_costly_scene(couple.scene);
    const double plain_ms = body != nullptr ? plain_loops_ms(*body) : 0;
    for (const NamedDetail& detail : surface_details) {
      const StepTime costly = step_time_of(couple.scene, detail.detail, frames);
      const StepTime beside = step_time_of(couple.neighbour, detail.detail, frames);
      std::vector<std::string> cells = {std::string(couple.scene),
                                        detail.name,
                                        fixed(costly.median_ms, 3),
                                        std::to_string(costly.contacts),
                                        std::string(couple.neighbour),
                                        fixed(beside.median_ms, 3),
                                        fixed(costly.median_ms / beside.median_ms, 2)};
      auto& figures = result.figures["scenes"].emplace_back();
      figures = {{"scene", couple.scene},         {"detail", detail.name},
                 {"ms", costly.median_ms},        {"contacts", costly.contacts},
                 {"neighbour", couple.neighbour}, {"neighbour_ms", beside.median_ms}};
      if (body != nullptr) {
        cells.push_back(fixed(plain_ms, 3));
        cells.push_back(fixed(costly.median_ms / plain_ms, 2));
        figures["plain_loops_ms"] = plain_ms;
      }
      print(table.row(cells));
    }
  }
  return result;
}

}  // namespace graze::tools
