#include "experiment/regions/subdivision_study.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "experiment/regions/bound_measure.hpp"
#include "experiment/regions/comparison_scenes.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

/// A partition with its leaves' size.
struct Division {
  Partition partition;
  std::uint32_t capacity;

  [[nodiscard]] std::string name() const {
    if (partition == Partition::octree) return name_of(partition);
    return format("%s, %u", name_of(partition), capacity);
  }
};

/// The octree's leaves are seldom full: the others are also made with leaves of half as many.
constexpr std::array<Division, 7> all_divisions = {{{Partition::octree, RegionTree::leaf_capacity},
                                                    {Partition::median, 30},
                                                    {Partition::median, 15},
                                                    {Partition::surface_halves, 30},
                                                    {Partition::surface_halves, 15},
                                                    {Partition::edge_collapse, 30},
                                                    {Partition::edge_collapse, 15}}};
constexpr std::size_t octree = 0;

struct DivisionResult {
  std::string name;
  std::uint64_t regions = 0, leaves = 0;
  std::uint32_t levels = 0;
  std::uint64_t bytes = 0;
  double build_ms = 0;
  std::uint64_t near_leaf_pairs = 0;
  BoundMeasure boxes, spheres;
};

struct SceneResult {
  std::string name, what;
  std::uint64_t vertices = 0;
  std::size_t frames = 0;
  double distance = 0;
  std::uint64_t near_pairs = 0;
  std::vector<DivisionResult> divisions;  ///< as `all_divisions`
};

bool is_of_folds(const SceneResult& result) {
  return result.name == "folding" || result.name == "unfolding";
}

DivisionResult measure_division(const PlacedFrames& placed, const Division& division, std::uint32_t runs) {
  const DividedScene divided(placed, division.partition, division.capacity);
  DivisionResult result;
  result.name = division.name();
  result.regions = divided.region_count();
  result.leaves = divided.leaf_count();
  result.levels = divided.level_count();
  result.bytes = divided.byte_count();
  result.build_ms = divided.build_ms();
  result.near_leaf_pairs = divided.near_leaf_pairs();
  result.boxes = measure_bound<AxisBox>(divided, runs);
  result.spheres = measure_bound<MiddleSphere>(divided, runs);
  return result;
}

SceneResult measure_scene(const bench::BenchScene& scene, const ExperimentOptions& options) {
  const PlacedFrames placed = place_frames(scene, compared_frames(options));
  SceneResult result{scene.name,
                     scene.what,
                     placed.vertex_count(),
                     placed.frames.size(),
                     scene.distance,
                     placed.near_pair_count(),
                     {}};
  for (const Division& division : all_divisions)
    result.divisions.push_back(measure_division(placed, division, options.runs));
  return result;
}

// Tables.

ResultTable scene_table(const std::vector<SceneResult>& results) {
  ResultTable table{"scenes", "The scenes",
                    columns_of({"scene", "what", "vertices", "frames", "distance",
                                "near_vertex_pairs: near vertex pairs, a frame"})};
  for (const SceneResult& result : results)
    table.rows.push_back({result.name, result.what, result.vertices, std::uint64_t{result.frames},
                          result.distance, a_frame(result.near_pairs, result.frames)});
  return table;
}

ResultTable tree_table(const std::vector<SceneResult>& results) {
  ResultTable table{"trees", "The trees",
                    columns_of({"scene", "partition", "regions", "levels", "vertices_a_leaf",
                                "tree_kb: tree, KB", "kb: boxes, KB"})};
  for (const SceneResult& result : results)
    for (const DivisionResult& each : result.divisions)
      table.rows.push_back({result.name, each.name, each.regions, std::uint64_t{each.levels},
                            static_cast<double>(result.vertices) / static_cast<double>(each.leaves),
                            static_cast<double>(each.bytes) / 1000,
                            static_cast<double>(each.regions * each.boxes.bytes_a_region) / 1000});
  return table;
}

ResultTable work_table(const std::vector<SceneResult>& results) {
  ResultTable table{
      "work", "Work a frame, with boxes and with the spheres of eq. 2",
      columns_of({"scene", "partition", "near_leaf_pairs", "box_tests: region pairs tested, boxes",
                  "box_leaf_pairs: leaf pairs reached, boxes",
                  "box_vertex_pairs: vertex pairs in the leaves reached, boxes",
                  "sphere_tests: region pairs tested, spheres",
                  "sphere_leaf_pairs: leaf pairs reached, spheres",
                  "sphere_vertex_pairs: vertex pairs in the leaves reached, spheres"})};
  for (const SceneResult& result : results)
    for (const DivisionResult& each : result.divisions)
      table.rows.push_back({result.name, each.name, a_frame(each.near_leaf_pairs, result.frames),
                            a_frame(each.boxes.walked.tested, result.frames),
                            a_frame(each.boxes.walked.reached, result.frames),
                            a_frame(each.boxes.leaf_vertex_pairs, result.frames),
                            a_frame(each.spheres.walked.tested, result.frames),
                            a_frame(each.spheres.walked.reached, result.frames),
                            a_frame(each.spheres.leaf_vertex_pairs, result.frames)});
  return table;
}

ResultTable level_table(const std::vector<SceneResult>& results) {
  ResultTable table{"levels", "Region pairs expanded a level, with boxes",
                    columns_of({"scene", "partition", "level", "expanded: a frame"})};
  table.shown = false;
  for (const SceneResult& result : results)
    for (const DivisionResult& each : result.divisions)
      for (std::size_t level = 0; level < each.boxes.walked.expanded.size(); ++level)
        table.rows.push_back({result.name, each.name, std::uint64_t{level},
                              a_frame(each.boxes.walked.expanded[level], result.frames)});
  return table;
}

ResultTable time_table(const std::vector<SceneResult>& results) {
  ResultTable table{"times", "Times: the build in ms, the rest in ms a frame",
                    columns_of({"scene", "partition", "build: build, once", "update: update, boxes",
                                "walk: walk, boxes", "leaves: leaves, boxes", "step: step, boxes",
                                "sphere_update: update, spheres", "sphere_step: step, spheres"})};
  table.timed = true;
  for (const SceneResult& result : results)
    for (const DivisionResult& each : result.divisions) {
      const auto frames = static_cast<double>(result.frames);
      table.rows.push_back({result.name, each.name, each.build_ms, each.boxes.update_ms / frames,
                            each.boxes.walk_ms / frames, each.boxes.leaf_ms / frames,
                            each.boxes.step_ms() / frames, each.spheres.update_ms / frames,
                            each.spheres.step_ms() / frames});
    }
  return table;
}

/// A partition beside the octree, by geometric means over all scenes.
struct BesideOctree {
  std::string name;
  double tests = 0, vertex_pairs = 0, sphere_vertex_pairs = 0, bytes = 0;  // the same in a second run
  double build = 0, update = 0, step = 0, sphere_step = 0;                 // times
  std::size_t faster_scenes = 0;
};

BesideOctree beside_octree(const std::vector<SceneResult>& results, std::size_t division) {
  const auto mean = [&](const auto& figure) {
    std::vector<double> ratios;
    ratios.reserve(results.size());
    for (const SceneResult& result : results)
      ratios.push_back(beside(figure(result.divisions[division]), figure(result.divisions[octree])));
    return geometric_mean(ratios);
  };
  const auto step = [](const DivisionResult& each) { return each.boxes.step_ms(); };
  BesideOctree result;
  if (!results.empty()) result.name = results.front().divisions[division].name;
  result.tests = mean([](const DivisionResult& each) { return each.boxes.walked.tested; });
  result.vertex_pairs = mean([](const DivisionResult& each) { return each.boxes.leaf_vertex_pairs; });
  result.sphere_vertex_pairs =
      mean([](const DivisionResult& each) { return each.spheres.leaf_vertex_pairs; });
  result.bytes = mean([](const DivisionResult& each) {
    return std::uint64_t{each.bytes + each.regions * each.boxes.bytes_a_region};
  });
  result.build = mean([](const DivisionResult& each) { return each.build_ms; });
  result.update = mean([](const DivisionResult& each) { return each.boxes.update_ms; });
  result.step = mean(step);
  result.sphere_step = mean([](const DivisionResult& each) { return each.spheres.step_ms(); });
  result.faster_scenes =
      static_cast<std::size_t>(std::count_if(results.begin(), results.end(), [&](const SceneResult& each) {
        return step(each.divisions[division]) < step(each.divisions[octree]);
      }));
  return result;
}

ResultTable beside_table(const std::vector<BesideOctree>& all) {
  ResultTable table{"beside_octree",
                    "Work relative to the octree (octree = 1), geometric means over the scenes",
                    columns_of({"partition", "tests: region pairs tested, boxes",
                                "vertex_pairs: vertex pairs in the leaves reached, boxes",
                                "sphere_vertex_pairs: vertex pairs in the leaves reached, spheres",
                                "bytes: memory, tree and boxes"})};
  for (const BesideOctree& each : all)
    table.rows.push_back({each.name, each.tests, each.vertex_pairs, each.sphere_vertex_pairs, each.bytes});
  return table;
}

ResultTable beside_time_table(const std::vector<BesideOctree>& all) {
  ResultTable table{
      "times_beside_octree", "Time relative to the octree (octree = 1), geometric means over the scenes",
      columns_of({"partition", "build", "update: update, boxes", "step: step, boxes",
                  "faster_scenes: scenes with a faster step, boxes", "sphere_step: step, spheres"})};
  table.timed = true;
  for (const BesideOctree& each : all)
    table.rows.push_back(
        {each.name, each.build, each.update, each.step, std::uint64_t{each.faster_scenes}, each.sphere_step});
  return table;
}

/// The vertex pairs in the leaves reached, frame by frame, by the octree and by leaves of about its size.
Figure frames_figure(const SceneResult& result, std::string name, std::string title) {
  Figure figure{std::move(name), std::move(title),
                "frame",         "vertex pairs in the leaves reached",
                false,           true,
                false,           {}};
  for (std::size_t i = 0; i < all_divisions.size(); ++i) {
    const DivisionResult& each = result.divisions[i];
    const bool has_full_leaves = i != octree && all_divisions[i].capacity == RegionTree::leaf_capacity;
    if (has_full_leaves) continue;
    Series series{each.name};
    for (const std::uint64_t pairs : each.boxes.leaf_vertex_pairs_by_frame)
      series.add(static_cast<double>(series.x.size()), static_cast<double>(pairs));
    figure.series.push_back(std::move(series));
  }
  return figure;
}

// The checks and the text of the study.

void check(const SceneResult& result, Study& study) {
  for (const DivisionResult& each : result.divisions)
    for (const BoundMeasure* bound : {&each.boxes, &each.spheres})
      if (bound->near_found != result.near_pairs)
        study.violations.push_back(format(
            "%s, %s, %s: %llu of %llu near vertex pairs are in the leaves reached", result.name.c_str(),
            each.name.c_str(), bound->bound.c_str(), number(bound->near_found), number(result.near_pairs)));
}

std::string text_of(const std::vector<BesideOctree>& all, const std::vector<SceneResult>& results,
                    const ComparisonScenes& scenes, bool with_times) {
  std::string text =
      "**What was measured.** The octree of regions is compared with other partitions of the same "
      "vertices.\n\n"
      "- *Octree*: eight equal boxes of a region's box, as in the library. A leaf has at most 30 "
      "vertices.\n"
      "- *Median*: halves of equal count across the longest side. It is a control that also goes by space "
      "alone.\n"
      "- *Surface halves*: halves of equal count by the distance along the surface between two far ends.\n"
      "- *Edge collapse*: bottom up. Of two adjacent regions those become one first that stay the most "
      "compact.\n\n"
      "The number after a name is how many vertices a leaf may have. The octree's leaves may have 30 but "
      "are seldom full. So 15 compares the partitions, and 30 shows what the same rule gives. All are "
      "measured over one kind of tree, with up to eight children a region, and by the same walk. All must "
      "find every near vertex pair.\n\n" +
      scenes.left_out;
  const auto fewest = std::min_element(
      all.begin(), all.end(),
      [](const BesideOctree& a, const BesideOctree& b) { return a.vertex_pairs < b.vertex_pairs; });
  text += format(
      "**Result.** *%s* leaves the fewest vertex pairs: %.2f of the octree's with boxes, and %.2f with "
      "spheres.\n\n",
      fewest->name.c_str(), fewest->vertex_pairs, fewest->sphere_vertex_pairs);
  for (const SceneResult& result : results) {
    if (!is_of_folds(result)) continue;
    const auto best = std::min_element(result.divisions.begin(), result.divisions.end(),
                                       [](const DivisionResult& a, const DivisionResult& b) {
                                         return a.boxes.leaf_vertex_pairs < b.boxes.leaf_vertex_pairs;
                                       });
    text += format("In the scene \"%s\" *%s* leaves the fewest, %.2f of the octree's. ", result.name.c_str(),
                   best->name.c_str(),
                   static_cast<double>(best->boxes.leaf_vertex_pairs) /
                       static_cast<double>(result.divisions[octree].boxes.leaf_vertex_pairs));
  }
  text += "\n\n";
  if (!with_times) return text;
  const auto fastest = std::min_element(
      all.begin(), all.end(), [](const BesideOctree& a, const BesideOctree& b) { return a.step < b.step; });
  if (fastest->name == all[octree].name) {
    text += "With boxes, the octree has the fastest step on average.";
  } else {
    text += format(
        "With boxes, *%s* has the fastest step on average, with %.2f of the octree's time. It is faster "
        "in %zu of %zu scenes, and takes %.1f times as long to build.",
        fastest->name.c_str(), fastest->step, fastest->faster_scenes, results.size(), fastest->build);
    std::vector<SceneResult> others = results;
    std::erase_if(others, is_of_folds);
    const BesideOctree without = beside_octree(others, static_cast<std::size_t>(fastest - all.begin()));
    text += format(" Without the two scenes of folds it takes %.2f.", without.step);
  }
  return text + "\n\n";
}

void add_claims(const std::vector<BesideOctree>& all, Study& study) {
  const auto spread = std::minmax_element(
      all.begin(), all.end(),
      [](const BesideOctree& a, const BesideOctree& b) { return a.vertex_pairs < b.vertex_pairs; });
  study.claims.push_back({"Another subdivision method can be used to partition the objects.",
                          format("All seven find every near pair. With boxes they leave from %.2f (%s) to "
                                 "%.2f (%s) of the octree's "
                                 "vertex pairs.",
                                 spread.first->vertex_pairs, spread.first->name.c_str(),
                                 spread.second->vertex_pairs, spread.second->name.c_str()),
                          study.violations.empty() ? "yes" : "no"});
}

}  // namespace

Study subdivision_study(const ExperimentOptions& options) {
  const ComparisonScenes scenes = partition_scenes(options);
  const auto results =
      measure_each(scenes, [&](const bench::BenchScene& scene) { return measure_scene(scene, options); });
  Study study;
  study.name = "subdivision";
  study.title = "Subdivision compared";
  for (const SceneResult& result : results) check(result, study);
  std::vector<BesideOctree> beside;
  for (std::size_t i = 0; i < all_divisions.size(); ++i) beside.push_back(beside_octree(results, i));
  study.text = text_of(beside, results, scenes, options.times);
  study.tables = {beside_table(beside), beside_time_table(beside), scene_table(results), tree_table(results),
                  work_table(results),  time_table(results),       level_table(results)};
  for (const SceneResult& result : results)
    if (is_of_folds(result))
      study.figures.push_back(frames_figure(
          result, result.name, "Two sheets, " + result.name + ": vertex pairs left, with boxes"));
  add_claims(beside, study);
  return study;
}

}  // namespace graze::tools
