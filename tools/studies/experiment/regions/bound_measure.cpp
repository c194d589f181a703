#include "experiment/regions/bound_measure.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "experiment/regions/bounding_volumes.hpp"

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
  explicit BoundedScene(const DividedScene& divided)
      : divided_(divided), points_(divided.scene().meshes.size()), volumes_(divided.scene().meshes.size()) {}

  void update(std::size_t frame) {
    frame_ = frame;
    for (std::size_t object = 0; object < volumes_.size(); ++object) {
      divided_.lay_out(object, frame, points_[object]);
      refit(PlacedRegions{divided_.hierarchy(object), points_[object], positions(object)}, volumes_[object]);
    }
  }

  /// All pairs of objects.
  void walk_all(WalkCounts& counts, std::vector<ReachedLeaves>& reached) const {
    for (std::uint32_t b = 1; b < volumes_.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        walk(pair(a, b), distance(), counts, [&](const NodePair& leaves) {
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
                                 divided_.hierarchy(object).nodes()[leaf]);
  }

  const DividedScene& divided_;
  std::size_t frame_ = 0;
  std::vector<std::vector<Eigen::Vector3d>> points_;
  std::vector<std::vector<Volume>> volumes_;
};

}  // namespace

template <typename Volume>
BoundMeasure measure_bound(const DividedScene& divided, std::uint32_t runs) {
  const PlacedFrames& scene = divided.scene();
  BoundMeasure measure;
  measure.bound = Volume::name;
  measure.bytes_a_region = sizeof(Volume);
  measure.regions = divided.region_count();
  BoundedScene<Volume> bounded(divided);
  for (std::uint32_t frame = 0; frame < scene.frames.size(); ++frame) {
    measure.update_ms += fastest_ms(runs, [&] { bounded.update(frame); });
    WalkCounts counts;
    std::vector<ReachedLeaves> reached;
    measure.walk_ms += fastest_ms(runs, [&] {
      counts = {.tested = 0, .reached = 0, .expanded = measure.walked.expanded};
      reached.clear();
      bounded.walk_all(counts, reached);
    });
    measure.walked.tested += counts.tested;
    measure.walked.reached += counts.reached;
    measure.walked.expanded = counts.expanded;
    measure.leaf_vertex_pairs_by_frame.push_back(bounded.vertex_pairs_in(reached));
    measure.leaf_vertex_pairs += measure.leaf_vertex_pairs_by_frame.back();
    std::uint64_t found = 0;
    measure.leaf_ms += fastest_ms(runs, [&] { found = bounded.near_vertices_in(reached); });
    measure.near_found += found;
  }
  return measure;
}

template BoundMeasure measure_bound<MiddleSphere>(const DividedScene&, std::uint32_t);
template BoundMeasure measure_bound<AxisBox>(const DividedScene&, std::uint32_t);
}  // namespace graze::tools
