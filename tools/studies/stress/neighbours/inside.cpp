#include "stress/neighbours/inside.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/inside_scenes.hpp"
#include "stress/details.hpp"
#include "stress/median.hpp"
#include "stress/neighbours/plain_tree.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;

struct InsideTime {
  std::vector<double> step_ms;
  std::vector<double> tree_ms;
  std::size_t contacts = 0;         ///< of the last step
  std::size_t wrong_distances = 0;  ///< of all steps
};

/// The distance of each vertex of the body from the solid, by a plain tree.
std::vector<double> distances_by(PlainTree& tree, const scenes::InsideScene& scene) {
  tree.refit();
  std::vector<double> distances;
  distances.reserve(scene.body().size());
  for (const Eigen::Vector3d& point : scene.body()) distances.push_back(tree.distance(point));
  return distances;
}

/// Counts the vertices of the body whose contact has another distance.
std::size_t count_wrong(const FrameReport& report, const std::vector<double>& distances) {
  constexpr double rounding = 1e-9;
  std::vector<double> found(distances.size(), -1);
  for (const Contact& contact : report.contacts())
    if (contact.feature_b.kind == FeatureKind::vertex) found[contact.feature_b.index] = contact.distance;
  std::size_t wrong = 0;
  for (std::size_t vertex = 0; vertex < found.size(); ++vertex)
    wrong += std::abs(found[vertex] - distances[vertex]) <= rounding ? 0U : 1U;
  return wrong;
}

InsideTime inside_time_of(std::string_view name, ContactDetail detail, std::size_t frames) {
  const auto played = scenes::make_inside_scene(name);
  SceneSettings settings = played->settings();
  settings.detail = detail;
  settings.threads = 1;
  Scene scene(settings);
  played->advance(scene, 0);
  PlainTree tree(played->triangles(), played->solid());
  InsideTime timed;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (frame > 0) played->advance(scene, frame);
    const ReportHandle report = scene.step();
    timed.step_ms.push_back(report->statistics().times.step_ms);
    timed.contacts = report->contacts().size();
    const auto start = Clock::now();
    const std::vector<double> distances = distances_by(tree, *played);
    timed.tree_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    if (detail == ContactDetail::nearest) timed.wrong_distances += count_wrong(*report, distances);
  }
  return timed;
}

}  // namespace

StressResult run_inside_study(std::size_t frames) {
  StressResult result;
  result.figures = {{"frames", frames}};
  const TextTable table({{"scene", 14, Align::left},
                         {"detail", 9, Align::left},
                         {"ms a step", 10},
                         {"contacts", 9},
                         {"plain tree, ms", 15},
                         {"ratio", 6}});
  print(table.head());
  for (const std::string_view name : scenes::inside_scene_names())
    for (const NamedDetail& detail : surface_details) {
      InsideTime timed = inside_time_of(name, detail.detail, frames);
      const double step = median_of(timed.step_ms);
      const double tree = median_of(timed.tree_ms);
      print(table.row({std::string(name), detail.name, fixed(step, 3), std::to_string(timed.contacts),
                       fixed(tree, 3), fixed(step / tree, 2)}));
      result.figures["scenes"].push_back({{"scene", name},
                                          {"detail", detail.name},
                                          {"ms", step},
                                          {"contacts", timed.contacts},
                                          {"plain_tree_ms", tree}});
      if (timed.wrong_distances > 0)
        result.violations.push_back(std::string(name) + ": " + std::to_string(timed.wrong_distances) +
                                    " distances are not those of the plain tree");
    }
  return result;
}

}  // namespace graze::tools
