#include "stress/neighbours/never_touching.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/scene_parts.hpp"
#include "stress/median.hpp"

namespace graze::tools {
namespace {

enum class Filter { fixed, group, layers, mixed, ignored };
constexpr std::array<std::pair<Filter, std::string_view>, 5> filters = {{{Filter::fixed, "fixed"},
                                                                         {Filter::group, "group"},
                                                                         {Filter::layers, "layers"},
                                                                         {Filter::mixed, "mixed"},
                                                                         {Filter::ignored, "ignored"}}};

/// The settings of box `index`. Mixed boxes are by turns fixed, of a group and of a layer, and their layers
/// exclude each other.
ObjectSettings settings_of_box(Filter filter, std::size_t index) {
  ObjectSettings settings;
  settings.motion = Motion::rigid;
  if (filter == Filter::mixed) {
    filter = filters[index % 3].first;
    settings.layer = 2U << index % 3;
    settings.collides_with = 1U | settings.layer;
  }
  if (filter == Filter::fixed) settings.motion = Motion::fixed;
  if (filter == Filter::group) settings.group = 1;
  if (filter == Filter::layers) {
    settings.layer = 8;
    settings.collides_with = 1;
  }
  return settings;
}

/// A heap of boxes that can never touch, and a ball far away.
class Heap {
 public:
  Heap(Filter filter, std::size_t count) : scene_({.range = 0.1, .threads = 1}) {
    ObjectSettings moving;
    moving.motion = Motion::rigid;
    ball_ = scene_.add(scenes::mesh_of(models::sphere(16, 9)), moving);
    const auto box = scenes::mesh_of(models::box({1, 1, 1}));
    std::vector<ObjectId> boxes;
    for (std::size_t index = 0; index < count; ++index) {
      boxes.push_back(scene_.add(box, settings_of_box(filter, index)));
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = Eigen::Vector3d(static_cast<double>(index % 7), static_cast<double>(index % 5),
                                           static_cast<double>(index % 3)) /
                           16;
      scene_.set_pose(boxes.back(), pose);
    }
    if (filter != Filter::ignored) return;
    for (std::size_t b = 0; b < boxes.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) scene_.ignore(boxes[a], boxes[b]);
  }
  ReportHandle step(std::size_t frame) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(100 + static_cast<double>(frame % 50), 0, 0);
    scene_.set_pose(ball_, pose);
    return scene_.step();
  }

 private:
  Scene scene_;
  ObjectId ball_;
};

struct HeapTime {
  double first_ms = 0;
  double median_ms = 0;
  std::uint64_t filtered = 0;
};

HeapTime heap_time_of(Filter filter, std::size_t count, std::size_t frames) {
  Heap heap(filter, count);
  HeapTime timed;
  timed.first_ms = heap.step(0)->statistics().times.step_ms;
  std::vector<double> times;
  for (std::size_t frame = 1; frame <= frames; ++frame) {
    const ReportHandle report = heap.step(frame);
    times.push_back(report->statistics().times.step_ms);
    timed.filtered = report->statistics().pairs_filtered;
  }
  timed.median_ms = median_of(times);
  return timed;
}

}  // namespace

StressResult run_never_touching_study(std::size_t frames) {
  StressResult result;
  result.figures = {{"frames", frames}};
  const TextTable table({{"filter", 8, Align::left},
                         {"boxes", 6},
                         {"pairs taken out", 16},
                         {"first step, ms", 15},
                         {"ms a step", 10},
                         {"us a box", 9}});
  print(table.head());
  const HeapTime alone = heap_time_of(Filter::fixed, 0, frames);
  print(table.row({"none", "0", "0", fixed(alone.first_ms, 3), fixed(alone.median_ms, 4), ""}));
  result.figures["alone"] = {{"first_ms", alone.first_ms}, {"ms", alone.median_ms}};
  for (const auto& [filter, name] : filters)
    for (const std::size_t count : {std::size_t{500}, std::size_t{2000}}) {
      const HeapTime timed = heap_time_of(filter, count, frames);
      const double of_box = 1000 * (timed.median_ms - alone.median_ms) / static_cast<double>(count);
      print(table.row({std::string(name), std::to_string(count), std::to_string(timed.filtered),
                       fixed(timed.first_ms, 3), fixed(timed.median_ms, 4), fixed(of_box, 3)}));
      result.figures["heaps"].push_back({{"filter", name},
                                         {"boxes", count},
                                         {"pairs_filtered", timed.filtered},
                                         {"first_ms", timed.first_ms},
                                         {"ms", timed.median_ms}});
    }
  return result;
}

}  // namespace graze::tools
