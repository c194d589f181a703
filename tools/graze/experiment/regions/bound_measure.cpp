#include "experiment/regions/bound_measure.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "experiment/regions/bounding_volumes.hpp"
#include "experiment/regions/swept_box.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The fastest of some runs of `work`, in ms.
template <typename Work>
double fastest_ms(std::uint32_t runs, const Work& work) {
  double fastest = std::numeric_limits<double>::infinity();
  for (std::uint32_t run = 0; run < std::max(1U, runs); ++run) {
    const Clock::time_point start = Clock::now();
    work();
    fastest = std::min(fastest, ms_since(start));
  }
  return fastest;
}

struct ReachedLeaves {
  std::uint32_t object_a, object_b;
  NodePair leaves;
};

/// One kind of bound over the objects of a scene.
template <typename Volume>
class BoundedScene {
 public:
  BoundedScene(const DividedScene& divided, const MeasureSettings& settings)
      : divided_(divided),
        settings_(settings),
        points_(divided.scene().meshes.size()),
        volumes_(divided.scene().meshes.size()) {}

  void update(std::size_t frame) {
    frame_ = frame;
    for (std::size_t object = 0; object < volumes_.size(); ++object) {
      divided_.lay_out(object, frame, settings_.cover, points_[object]);
      refit(PlacedRegions{divided_.hierarchy(object), settings_.cover, points_[object], positions(object)},
            volumes_[object]);
    }
  }

  /// All pairs of objects; `test(a, b, pair)` as for `walk`.
  template <typename Test>
  void walk_all(WalkCounts& counts, std::vector<ReachedLeaves>& reached, const Test& test) const {
    for (std::uint32_t b = 1; b < volumes_.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        walk(
            pair(a, b), distance(), counts, [&](const NodePair& regions) { test(a, b, regions); },
            [&](const NodePair& leaves) {
              reached.push_back({a, b, leaves});
            });
  }

  /// The vertices nearer than the distance in the leaves that were reached, each pair of vertices looked at.
  [[nodiscard]] std::uint64_t near_vertices_in(std::span<const ReachedLeaves> reached) const {
    std::uint64_t found = 0;
    for (const ReachedLeaves& each : reached)
      for (const Eigen::Vector3d& p : points_of(each.object_a, each.leaves.a))
        for (const Eigen::Vector3d& q : points_of(each.object_b, each.leaves.b))
          found += is_near(p, q, distance()) ? 1U : 0U;
    return found;
  }
  [[nodiscard]] std::uint64_t vertex_pairs_in(std::span<const ReachedLeaves> reached) const {
    std::uint64_t count = 0;
    for (const ReachedLeaves& each : reached)
      count += std::uint64_t{divided_.hierarchy(each.object_a).nodes()[each.leaves.a].vertex_count} *
               divided_.hierarchy(each.object_b).nodes()[each.leaves.b].vertex_count;
    return count;
  }

  /// Counts BoundMeasure::corner_pairs_left. Boxes of leaves are made when they are first asked for, for all
  /// kinds of bound alike.
  [[nodiscard]] std::uint64_t corner_pairs_left(std::span<const ReachedLeaves> reached) {
    leaf_boxes_.resize(volumes_.size());
    for (std::size_t object = 0; object < volumes_.size(); ++object)
      leaf_boxes_[object].assign(divided_.hierarchy(object).nodes().size(), Box());
    std::uint64_t left = 0;
    for (const ReachedLeaves& each : reached) {
      const Box& box_a = leaf_box(each.object_a, each.leaves.a);
      const Box& box_b = leaf_box(each.object_b, each.leaves.b);
      if (graze::lower_distance(box_a, box_b) >= distance()) continue;
      left += count_within(each.object_a, each.leaves.a, grown(box_b, distance())) *
              count_within(each.object_b, each.leaves.b, grown(box_a, distance()));
    }
    return left;
  }

  /// Their sum, so that nothing is left out.
  [[nodiscard]] double test_all(const TimedTests::Of& timed) const {
    const BoundedPair<Volume> both = pair(timed.object_a, timed.object_b);
    double sum = 0;
    for (const NodePair& regions : timed.pairs) sum += lower_distance(both.a[regions.a], both.b[regions.b]);
    return sum;
  }

 private:
  [[nodiscard]] double distance() const { return divided_.scene().distance; }
  [[nodiscard]] std::span<const Eigen::Vector3d> positions(std::size_t object) const {
    return divided_.scene().frames[frame_].positions[object];
  }
  [[nodiscard]] BoundedPair<Volume> pair(std::size_t a, std::size_t b) const {
    return {divided_.hierarchy(a).nodes(), divided_.hierarchy(b).nodes(), volumes_[a], volumes_[b]};
  }
  [[nodiscard]] std::span<const Eigen::Vector3d> points_of(std::uint32_t object, std::uint32_t leaf) const {
    return RegionHierarchy::part(std::span<const Eigen::Vector3d>(points_[object]),
                                 divided_.hierarchy(object).nodes()[leaf], settings_.cover);
  }

  const Box& leaf_box(std::uint32_t object, std::uint32_t leaf) {
    Box& box = leaf_boxes_[object][leaf];
    if (box.empty())
      for (const Eigen::Vector3d& point : points_of(object, leaf)) box.add(point);
    return box;
  }
  [[nodiscard]] std::uint64_t count_within(std::uint32_t object, std::uint32_t leaf, const Box& box) const {
    const auto points = points_of(object, leaf);
    return static_cast<std::uint64_t>(
        std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
          return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
        }));
  }

  const DividedScene& divided_;
  const MeasureSettings& settings_;
  std::size_t frame_ = 0;
  std::vector<std::vector<Eigen::Vector3d>> points_;
  std::vector<std::vector<Volume>> volumes_;
  std::vector<std::vector<Box>> leaf_boxes_;  ///< empty where none is made yet
};

constexpr auto no_test = [](std::uint32_t, std::uint32_t, const NodePair&) {};

}  // namespace

TimedTests tests_of_boxes(const DividedScene& divided, const MeasureSettings& settings) {
  TimedTests timed;
  BoundedScene<AxisBox> bounded(divided, settings);
  for (std::uint32_t frame = 0; frame < divided.scene().frames.size(); ++frame) {
    bounded.update(frame);
    WalkCounts counts;
    std::vector<ReachedLeaves> reached;
    bounded.walk_all(counts, reached, [&](std::uint32_t a, std::uint32_t b, const NodePair& pair) {
      const bool is_next = timed.tests.empty() || timed.tests.back().frame != frame ||
                           timed.tests.back().object_a != a || timed.tests.back().object_b != b;
      if (is_next) timed.tests.push_back({frame, a, b, {}});
      timed.tests.back().pairs.push_back(pair);
    });
  }
  return timed;
}

template <typename Volume>
BoundMeasure measure_bound(const DividedScene& divided, const MeasureSettings& settings,
                           const TimedTests& timed) {
  const PlacedFrames& scene = divided.scene();
  BoundMeasure measure;
  measure.bound = Volume::name;
  measure.bytes_a_region = sizeof(Volume);
  measure.regions = divided.region_count();
  BoundedScene<Volume> bounded(divided, settings);
  double test_ms = 0;
  std::uint64_t tests = 0;
  volatile double sum = 0;
  auto timed_of_frame = timed.tests.begin();
  for (std::uint32_t frame = 0; frame < scene.frames.size(); ++frame) {
    measure.update_ms += fastest_ms(settings.runs, [&] { bounded.update(frame); });
    WalkCounts counts;
    std::vector<ReachedLeaves> reached;
    measure.walk_ms += fastest_ms(settings.runs, [&] {
      counts = {.tested = 0, .reached = 0, .expanded = measure.walked.expanded};
      reached.clear();
      bounded.walk_all(counts, reached, no_test);
    });
    measure.walked.tested += counts.tested;
    measure.walked.reached += counts.reached;
    measure.walked.expanded = counts.expanded;
    measure.leaf_vertex_pairs_by_frame.push_back(bounded.vertex_pairs_in(reached));
    measure.leaf_vertex_pairs += measure.leaf_vertex_pairs_by_frame.back();
    if (settings.cover == Cover::vertices) {
      std::uint64_t found = 0;
      measure.leaf_ms += fastest_ms(settings.runs, [&] { found = bounded.near_vertices_in(reached); });
      measure.near_found += found;
    } else {
      std::uint64_t left = 0;
      measure.leaf_ms += fastest_ms(settings.runs, [&] { left = bounded.corner_pairs_left(reached); });
      measure.corner_pairs_left += left;
    }
    for (; timed_of_frame != timed.tests.end() && timed_of_frame->frame == frame; ++timed_of_frame) {
      test_ms += fastest_ms(settings.runs, [&] { sum = sum + bounded.test_all(*timed_of_frame); });
      tests += timed_of_frame->pairs.size();
    }
  }
  if (tests > 0) measure.test_ns = test_ms * 1e6 / static_cast<double>(tests);
  return measure;
}

template BoundMeasure measure_bound<MiddleSphere>(const DividedScene&, const MeasureSettings&,
                                                  const TimedTests&);
template BoundMeasure measure_bound<CentredSphere>(const DividedScene&, const MeasureSettings&,
                                                   const TimedTests&);
template BoundMeasure measure_bound<AxisBox>(const DividedScene&, const MeasureSettings&, const TimedTests&);
template BoundMeasure measure_bound<SweptBox<1>>(const DividedScene&, const MeasureSettings&,
                                                 const TimedTests&);
template BoundMeasure measure_bound<SweptBox<2>>(const DividedScene&, const MeasureSettings&,
                                                 const TimedTests&);
template BoundMeasure measure_bound<SweptBox<3>>(const DividedScene&, const MeasureSettings&,
                                                 const TimedTests&);
template BoundMeasure measure_bound<DirectionPolytope<14>>(const DividedScene&, const MeasureSettings&,
                                                           const TimedTests&);
template BoundMeasure measure_bound<DirectionPolytope<18>>(const DividedScene&, const MeasureSettings&,
                                                           const TimedTests&);
template BoundMeasure measure_bound<DirectionPolytope<26>>(const DividedScene&, const MeasureSettings&,
                                                           const TimedTests&);

}  // namespace graze::tools
