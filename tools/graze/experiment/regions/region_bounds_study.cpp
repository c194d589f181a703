#include "experiment/regions/region_bounds_study.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "experiment/regions/bound_measure.hpp"
#include "experiment/regions/comparison_scenes.hpp"
#include "experiment/regions/swept_box.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

using MeasureBound = BoundMeasure (*)(const DividedScene&, const MeasureSettings&, const TimedTests&);

constexpr std::array<MeasureBound, 9> all_bounds = {measure_bound<MiddleSphere>,
                                                    measure_bound<CentredSphere>,
                                                    measure_bound<AxisBox>,
                                                    measure_bound<SweptBox<3>>,
                                                    measure_bound<SweptBox<1>>,
                                                    measure_bound<SweptBox<2>>,
                                                    measure_bound<DirectionPolytope<14>>,
                                                    measure_bound<DirectionPolytope<18>>,
                                                    measure_bound<DirectionPolytope<26>>};
constexpr std::size_t middle_sphere = 0, axis_box = 2;

/// All kinds of bound on one scene.
struct SceneResult {
  std::string name, what;
  std::uint64_t vertices = 0, regions = 0;
  std::size_t frames = 0;
  double distance = 0;
  std::uint64_t near_pairs = 0, near_leaf_pairs = 0;  ///< of vertices, of all frames
  std::vector<BoundMeasure> of_vertices, of_faces;    ///< as `all_bounds`
};

std::vector<BoundMeasure> measure_all(const DividedScene& divided, const MeasureSettings& settings) {
  const TimedTests timed = tests_of_boxes(divided, settings);
  std::vector<BoundMeasure> measures;
  measures.reserve(all_bounds.size());
  for (const MeasureBound measure : all_bounds) measures.push_back(measure(divided, settings, timed));
  return measures;
}

SceneResult measure_scene(const bench::BenchScene& scene, const ExperimentOptions& options) {
  const PlacedFrames placed = place_frames(scene, compared_frames(options));
  const DividedScene divided(placed, Partition::octree);
  SceneResult result;
  result.name = scene.name;
  result.what = scene.what;
  result.vertices = placed.vertex_count();
  result.regions = divided.region_count();
  result.frames = placed.frames.size();
  result.distance = scene.distance;
  result.near_pairs = placed.near_pair_count();
  result.near_leaf_pairs = divided.near_leaf_pairs();
  result.of_vertices = measure_all(divided, {Cover::vertices, options.runs});
  result.of_faces = measure_all(divided, {Cover::faces, options.runs});
  return result;
}

// Tables.

ResultTable scene_table(const std::vector<SceneResult>& results) {
  ResultTable table{"scenes", "The scenes",
                    columns_of({"scene", "what", "vertices", "regions", "frames", "distance",
                                "near_vertex_pairs: near vertex pairs, a frame",
                                "near_leaf_pairs: near leaf pairs, a frame"})};
  for (const SceneResult& result : results)
    table.rows.push_back({result.name, result.what, result.vertices, result.regions,
                          std::uint64_t{result.frames}, result.distance,
                          a_frame(result.near_pairs, result.frames),
                          a_frame(result.near_leaf_pairs, result.frames)});
  return table;
}

ResultTable tightness_table(const std::vector<SceneResult>& results) {
  ResultTable table{
      "tightness", "How tight: work a frame, by bound",
      columns_of({"scene", "bound", "bytes_a_region", "tests: region pairs tested",
                  "leaf_pairs: leaf pairs reached", "of_near: leaf pairs reached / near leaf pairs",
                  "vertex_pairs: vertex pairs in the leaves reached",
                  "face_tests: region pairs tested, bounds of faces",
                  "face_leaf_pairs: leaf pairs reached, bounds of faces",
                  "corner_pairs: corner pairs left after clipping"})};
  for (const SceneResult& result : results)
    for (std::size_t i = 0; i < all_bounds.size(); ++i) {
      const BoundMeasure& bound = result.of_vertices[i];
      const BoundMeasure& faces = result.of_faces[i];
      table.rows.push_back(
          {result.name, bound.bound, bound.bytes_a_region, a_frame(bound.walked.tested, result.frames),
           a_frame(bound.walked.reached, result.frames),
           static_cast<double>(bound.walked.reached) /
               static_cast<double>(std::max<std::uint64_t>(1, result.near_leaf_pairs)),
           a_frame(bound.leaf_vertex_pairs, result.frames), a_frame(faces.walked.tested, result.frames),
           a_frame(faces.walked.reached, result.frames), a_frame(faces.corner_pairs_left, result.frames)});
    }
  return table;
}

ResultTable level_table(const std::vector<SceneResult>& results) {
  ResultTable table{"levels", "Region pairs expanded a level",
                    columns_of({"scene", "bound", "level", "expanded: a frame"})};
  table.shown = false;
  for (const SceneResult& result : results)
    for (const BoundMeasure& bound : result.of_vertices)
      for (std::size_t level = 0; level < bound.walked.expanded.size(); ++level)
        table.rows.push_back({result.name, bound.bound, std::uint64_t{level},
                              a_frame(bound.walked.expanded[level], result.frames)});
  return table;
}

ResultTable time_table(const std::vector<SceneResult>& results) {
  ResultTable table{"times", "Times: one test of two regions in ns, the rest in ms a frame",
                    columns_of({"scene", "bound", "test_ns: one test", "update", "walk", "leaves", "step",
                                "face_update: update, faces", "face_walk: walk, faces",
                                "face_leaves: leaves, faces", "face_step: step, faces"})};
  table.timed = true;
  for (const SceneResult& result : results)
    for (std::size_t i = 0; i < all_bounds.size(); ++i) {
      const BoundMeasure& bound = result.of_vertices[i];
      const BoundMeasure& faces = result.of_faces[i];
      const auto frames = static_cast<double>(result.frames);
      table.rows.push_back({result.name, bound.bound, bound.test_ns, bound.update_ms / frames,
                            bound.walk_ms / frames, bound.leaf_ms / frames, bound.step_ms() / frames,
                            faces.update_ms / frames, faces.walk_ms / frames, faces.leaf_ms / frames,
                            faces.step_ms() / frames});
    }
  return table;
}

/// A bound beside the box, by geometric means over all scenes.
struct BesideBox {
  std::string bound;
  double tests = 0, leaf_pairs = 0, face_leaf_pairs = 0, corner_pairs = 0;  // the same in a second run
  double test_ns = 0, update = 0, walk = 0, step = 0, face_step = 0;        // times
  std::size_t faster_scenes = 0, faster_face_scenes = 0;
};

BesideBox beside_box(const std::vector<SceneResult>& results, std::size_t bound) {
  const auto ratio_in = [&](const std::vector<BoundMeasure>& measures, const auto& figure) {
    return beside(figure(measures[bound]), figure(measures[axis_box]));
  };
  const auto mean = [&](const auto& measures, const auto& figure) {
    std::vector<double> ratios;
    ratios.reserve(results.size());
    for (const SceneResult& result : results) ratios.push_back(ratio_in(result.*measures, figure));
    return geometric_mean(ratios);
  };
  const auto faster = [&](const auto& measures) {
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [&](const SceneResult& result) {
          return (result.*measures)[bound].step_ms() < (result.*measures)[axis_box].step_ms();
        }));
  };
  const auto vertices = &SceneResult::of_vertices;
  const auto faces = &SceneResult::of_faces;
  const auto reached = [](const BoundMeasure& each) { return each.walked.reached; };
  const auto step = [](const BoundMeasure& each) { return each.step_ms(); };
  BesideBox result;
  result.bound = results.front().of_vertices[bound].bound;
  result.tests = mean(vertices, [](const BoundMeasure& each) { return each.walked.tested; });
  result.leaf_pairs = mean(vertices, reached);
  result.face_leaf_pairs = mean(faces, reached);
  result.corner_pairs = mean(faces, [](const BoundMeasure& each) { return each.corner_pairs_left; });
  result.test_ns = mean(vertices, [](const BoundMeasure& each) { return each.test_ns; });
  result.update = mean(vertices, [](const BoundMeasure& each) { return each.update_ms; });
  result.walk = mean(vertices, [](const BoundMeasure& each) { return each.walk_ms; });
  result.step = mean(vertices, step);
  result.face_step = mean(faces, step);
  result.faster_scenes = faster(vertices);
  result.faster_face_scenes = faster(faces);
  return result;
}

ResultTable beside_box_table(const std::vector<BesideBox>& all) {
  ResultTable table{"beside_box", "Work relative to the box (box = 1), geometric means over the scenes",
                    columns_of({"bound", "tests: region pairs tested", "leaf_pairs: leaf pairs reached",
                                "face_leaf_pairs: leaf pairs reached, bounds of faces",
                                "corner_pairs: corner pairs left after clipping"})};
  for (const BesideBox& each : all)
    table.rows.push_back({each.bound, each.tests, each.leaf_pairs, each.face_leaf_pairs, each.corner_pairs});
  return table;
}

ResultTable beside_box_time_table(const std::vector<BesideBox>& all) {
  ResultTable table{
      "times_beside_box", "Time relative to the box (box = 1), geometric means over the scenes",
      columns_of({"bound", "test: one test", "update", "walk", "step: step, vertices",
                  "faster_scenes: scenes with a faster step, vertices", "face_step: step, faces",
                  "faster_face_scenes: scenes with a faster step, faces"})};
  table.timed = true;
  for (const BesideBox& each : all)
    table.rows.push_back({each.bound, each.test_ns, each.update, each.walk, each.step,
                          std::uint64_t{each.faster_scenes}, each.face_step,
                          std::uint64_t{each.faster_face_scenes}});
  return table;
}

// Figures.

Figure time_figure(const std::vector<SceneResult>& results) {
  Figure figure{"time",
                "Tightness and time beside the box's, a point for each scene",
                "leaf pairs reached, of the box's",
                "update and walk, of the box's",
                true,
                true,
                true,
                {}};
  for (std::size_t i = 0; i < all_bounds.size(); ++i) {
    Series series{results.front().of_vertices[i].bound, {}, {}, false};
    for (const SceneResult& result : results) {
      const BoundMeasure& box = result.of_vertices[axis_box];
      const BoundMeasure& bound = result.of_vertices[i];
      if (bound.walked.reached == 0 || box.walked.reached == 0) continue;
      series.add(static_cast<double>(bound.walked.reached) / static_cast<double>(box.walked.reached),
                 bound.search_ms() / box.search_ms());
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

/// Leaf pairs reached over those that are near, against the distance, for the paper's models, whose own
/// distance is one mean edge length.
void add_distances(const bench::BenchScene& models, const ExperimentOptions& options, Study& study) {
  Figure figure{"distance",
                "Leaf pairs reached for each that is near: the paper's models",
                "distance, in mean edge lengths",
                "leaf pairs reached, of the near ones",
                true,
                true,
                false,
                {}};
  ResultTable table{
      "distance", figure.title,
      columns_of({"edges: distance, in mean edge lengths", "near_leaf_pairs: near leaf pairs, a frame"})};
  bench::BenchScene scene = models;
  const double edge_length = models.distance;
  for (const double edges : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    scene.distance = edges * edge_length;
    const PlacedFrames placed = place_frames(scene, compared_frames(options));
    const DividedScene divided(placed, Partition::octree);
    const std::uint64_t near = divided.near_leaf_pairs();
    if (near == 0) continue;
    std::vector<Cell> row{edges, a_frame(near, placed.frames.size())};
    for (std::size_t i = 0; i < all_bounds.size(); ++i) {
      const BoundMeasure bound = all_bounds[i](divided, {Cover::vertices, 1}, {});
      if (figure.series.size() <= i) {
        figure.series.push_back({bound.bound});
        table.columns.push_back({format("bound_%zu", i + 1), bound.bound});
      }
      const double ratio = static_cast<double>(bound.walked.reached) / static_cast<double>(near);
      figure.series[i].add(edges, ratio);
      row.emplace_back(ratio);
    }
    table.rows.push_back(std::move(row));
  }
  study.figures.push_back(std::move(figure));
  study.tables.push_back(std::move(table));
}

// The checks and the text of the study.

void check(const SceneResult& result, Study& study) {
  for (const BoundMeasure& bound : result.of_vertices)
    if (bound.near_found != result.near_pairs)
      study.violations.push_back(format("%s, %s: %llu of %llu near vertex pairs are in the leaves reached",
                                        result.name.c_str(), bound.bound.c_str(), number(bound.near_found),
                                        number(result.near_pairs)));
}

std::string text_of(const std::vector<BesideBox>& all, const ComparisonScenes& scenes,
                    std::size_t scene_count, bool with_times) {
  std::string text =
      "**What was measured.** The paper's conclusion names a comparison with other methods as future "
      "work: \"the intersection test, tight fitting, computation time, and the use of memory\". Nine "
      "kinds of bound are compared here over the same regions, those of graze's octree.\n\n"
      "- *Middle-vertex sphere*: the paper's sphere (eq. 2).\n"
      "- *Centred sphere*: a sphere about the centre of the region's box.\n"
      "- *Box*: along the coordinate axes. It is the one that the library has.\n"
      "- *Oriented box*: along the principal axes.\n"
      "- *Line swept sphere*: a sphere swept along a segment, which lies along a principal axis.\n"
      "- *Rectangle swept sphere*: a sphere swept along a rectangle, which lies along two principal axes.\n"
      "- *14-DOP*: 14 sides, across the axes and the cube's diagonals.\n"
      "- *18-DOP*: 18 sides, across the axes and the faces' diagonals.\n"
      "- *26-DOP*: 26 sides, across all of these directions.\n\n"
      "These are the conditions:\n\n"
      "- The walk is breadth first, as DMV. A pair of regions is expanded where its lower bound is below "
      "the distance.\n"
      "- Arithmetic is double, rounded to the safe side.\n"
      "- Each bound must find all vertex pairs within the distance. A grid without a hierarchy says "
      "which.\n"
      "- All regions are updated in each frame. A box or k-DOP of an inner region is made from its "
      "children, which gives the same. All other bounds are made from all vertices of the region.\n"
      "- The lower bound of oriented boxes and swept spheres is the gap along a direction that three "
      "rounds of alternating projections find.\n"
      "- A step between vertices is update, walk, and every vertex pair of the leaves reached.\n"
      "- A step between faces is for contacts between features. Bounds cover faces, and a step is update, "
      "walk and clipping: each leaf reached keeps the corners within the distance of the other's box, as "
      "graze does first. A pair reached in vain is left early.\n\n" +
      scenes.left_out;
  const auto fewest = std::min_element(all.begin(), all.end(), [](const BesideBox& a, const BesideBox& b) {
    return a.leaf_pairs < b.leaf_pairs;
  });
  text += format(
      "**Result.** The tightest bound is the %s, with %.2f of the box's leaf pairs. The sphere of eq. 2 "
      "reaches %.1f times as many leaf pairs as the box.\n\n",
      fewest->bound.c_str(), fewest->leaf_pairs, all[middle_sphere].leaf_pairs);
  text += format(
      "For features this bound leaves %.2f of the pairs of corners that the box leaves. Pairs that "
      "clipping by the leaves' boxes removes anyway do not count here.\n\n",
      fewest->corner_pairs);
  if (!with_times) return text;
  const auto fastest = std::min_element(
      all.begin(), all.end(), [](const BesideBox& a, const BesideBox& b) { return a.step < b.step; });
  const auto fastest_faces =
      std::min_element(all.begin(), all.end(),
                       [](const BesideBox& a, const BesideBox& b) { return a.face_step < b.face_step; });
  const auto verdict = [&](const BesideBox& winner, double ratio, std::size_t scenes_won) {
    return winner.bound == all[axis_box].bound
               ? std::string("the box, which the library has, is the fastest on average")
               : format("the %s takes %.2f of the box's time on average and is faster in %zu of %zu scenes",
                        winner.bound.c_str(), ratio, scenes_won, scene_count);
  };
  text += "For a step between vertices, " + verdict(*fastest, fastest->step, fastest->faster_scenes) +
          ". For a step between faces, " +
          verdict(*fastest_faces, fastest_faces->face_step, fastest_faces->faster_face_scenes) + ".\n\n";
  return text;
}

void add_claims(const std::vector<BesideBox>& all, const std::vector<SceneResult>& results, bool with_times,
                Study& study) {
  const BesideBox& sphere = all[middle_sphere];
  const auto median_test_ns = [&](std::size_t bound) {
    std::vector<double> ns;
    ns.reserve(results.size());
    for (const SceneResult& result : results) ns.push_back(result.of_vertices[bound].test_ns);
    std::nth_element(ns.begin(), ns.begin() + static_cast<std::ptrdiff_t>(ns.size() / 2), ns.end());
    return ns[ns.size() / 2];
  };
  Claim test{"The most employed computation is the Euclidean distance, a cheap operation.",
             format("The walk needs %.1f times as many of them as of boxes.", sphere.tests), "not by itself"};
  if (with_times)
    test.measured = format(
        "One test of two spheres takes %.1f ns, of two boxes %.1f ns. The walk needs %.1f times as "
        "many of the former and takes %.1f times as long.",
        median_test_ns(middle_sphere), median_test_ns(axis_box), sphere.tests, sphere.walk);
  if (with_times) test.holds = sphere.walk < 1 ? "yes" : "the test is cheap, but too many are needed";
  study.claims.push_back(std::move(test));
  Claim memory{
      "Only one parameter is required to be updated per region; a sphere needs a 3D vector and a float.",
      format("8 bytes a region change (the radius, in double) beside 32 of a sphere and 48 of a box. "
             "The sphere of eq. 2 reaches %.1f times as many leaf pairs as the box.",
             sphere.leaf_pairs),
      "yes, at the price of tightness"};
  if (with_times)
    memory.measured += format(
        " The update, over all vertices of every level, takes %.1f times the box's, "
        "which goes up from the leaves.",
        sphere.update);
  study.claims.push_back(std::move(memory));
}

}  // namespace

Study region_bounds_study(const ExperimentOptions& options) {
  const ComparisonScenes scenes = bound_scenes(options);
  const auto results =
      measure_each(scenes, [&](const bench::BenchScene& scene) { return measure_scene(scene, options); });
  Study study;
  study.name = "bounds";
  study.title = "Region bounds compared";
  for (const SceneResult& result : results) check(result, study);
  std::vector<BesideBox> beside;
  for (std::size_t i = 0; i < all_bounds.size(); ++i) beside.push_back(beside_box(results, i));
  study.text = text_of(beside, scenes, results.size(), options.times);
  study.tables = {beside_box_table(beside), beside_box_time_table(beside), scene_table(results),
                  tightness_table(results), time_table(results),           level_table(results)};
  study.figures.push_back(time_figure(results));
  add_distances(scenes.scenes.front(), options, study);
  add_claims(beside, results, options.times, study);
  return study;
}

}  // namespace graze::tools
