// The distances of regions in a report (the paper's cd) against a plain walk of the trees.

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "core/base/box.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/search/large_pair.hpp"
#include "models/models.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using RegionKey =
    std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  ///< level, region of a, region of b

Box box_of(const Mesh& mesh, const Positions& positions, const Region& region, bool about_vertices) {
  Box box;
  for (const std::uint32_t vertex : indexed(mesh).regions().vertices(region)) box.add(positions[vertex]);
  if (about_vertices) return box;
  for (const std::uint32_t face : indexed(mesh).regions().faces(region))
    for (const std::uint32_t corner : mesh.face(face)) box.add(positions[corner]);
  for (const std::uint32_t edge : indexed(mesh).regions().edges(region))
    for (const std::uint32_t end : mesh.edge(edge)) box.add(positions[end]);
  return box;
}

/// Eq. 2.
double radius_of(const Mesh& mesh, const Positions& positions, const Region& region) {
  double radius = 0;
  for (const std::uint32_t vertex : indexed(mesh).regions().vertices(region))
    radius = std::max(radius, (positions[vertex] - positions[region.middle]).norm());
  return radius;
}

double gap(const Box& a, const Box& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0).norm();
}

/// Two surfaces, and which of their pairs of regions are alive.
struct PlainWalk {
  const Mesh& mesh_a;
  const Mesh& mesh_b;
  Positions a;
  Positions b;
  SceneSettings settings;
  std::set<RegionKey> alive;

  [[nodiscard]] bool passes(const Region& region_a, const Region& region_b, std::uint32_t level) const {
    const bool about_vertices = settings.detail == ContactDetail::vertices;
    const double middles = (a[region_a.middle] - b[region_b.middle]).norm();
    if (settings.accuracy.mode() == AccuracyMode::paper) {
      const auto& epsilon = settings.accuracy.epsilon();
      return middles < epsilon[std::min<std::size_t>(level, epsilon.size() - 1) - 1];
    }
    const double boxes =
        gap(box_of(mesh_a, a, region_a, about_vertices), box_of(mesh_b, b, region_b, about_vertices));
    const double spheres = middles - radius_of(mesh_a, a, region_a) - radius_of(mesh_b, b, region_b);
    return (about_vertices ? std::max(boxes, spheres) : boxes) < settings.range;
  }

  void visit(std::uint32_t index_a, std::uint32_t index_b) {
    const Region& region_a = indexed(mesh_a).regions().region(index_a);
    const Region& region_b = indexed(mesh_b).regions().region(index_b);
    const std::uint32_t level = std::max(region_a.level, region_b.level);
    if (level > 0 && !passes(region_a, region_b, level)) return;
    if (level > 0) alive.insert({level, index_a, index_b});
    if (region_a.is_leaf() && region_b.is_leaf()) return;
    const auto children = [](const Region& region, std::uint32_t index) {
      return region.is_leaf() ? std::pair(index, index + 1)
                              : std::pair(region.first_child, region.first_child + region.child_count);
    };
    const auto [begin_a, end_a] = children(region_a, index_a);
    const auto [begin_b, end_b] = children(region_b, index_b);
    for (std::uint32_t i = begin_a; i < end_a; ++i)
      for (std::uint32_t j = begin_b; j < end_b; ++j) visit(i, j);
  }
};

std::set<RegionKey> keys_of(std::span<const RegionDistance> distances) {
  std::set<RegionKey> keys;
  for (const RegionDistance& distance : distances)
    keys.insert({distance.level, distance.region_a, distance.region_b});
  return keys;
}

SceneSettings settings_with(ContactDetail detail, std::size_t capacity, const Accuracy& accuracy = {}) {
  SceneSettings settings = settings_of(0.05, 0.2, detail);
  settings.accuracy = accuracy;
  settings.region_distances = capacity;
  return settings;
}

}  // namespace

TEST_CASE("region distances: those of a plain walk, in every frame of a passage") {
  const auto mesh_a = mesh_of(models::torus());
  const auto mesh_b = mesh_of(models::pawn());
  std::size_t compared = 0;
  for (const SceneSettings& settings :
       {settings_with(ContactDetail::none, 1'000'000), settings_with(ContactDetail::features, 1'000'000),
        settings_with(ContactDetail::vertices, 1'000'000),
        settings_with(ContactDetail::regions, 1'000'000, Accuracy::paper({1.2, 0.5, 0.1}))}) {
    Scene scene(settings);
    const ObjectId a = scene.add(mesh_a);
    const ObjectId b = scene.add(mesh_b);
    std::set<std::size_t> counts;
    for (int frame = 0; frame < 24; ++frame) {
      // Towards each other and back, so that lines come and go. At rest now and then.
      const double way = 1.8 - 0.08 * std::min(frame / 2 * 2, 24 - frame);
      const Positions at_a(mesh_a->rest().begin(), mesh_a->rest().end());
      const Positions at_b = moved(mesh_b->rest(), {way, 0.01, 0.02});
      scene.set_positions(b, PositionView(at_b));
      const ReportHandle report = scene.step();
      PlainWalk plain{*mesh_a, *mesh_b, at_a, at_b, settings, {}};
      const PairReport* const row = find_pair(*report, a, b);
      if (row == nullptr) continue;
      plain.visit(0, 0);
      INFO("frame " << frame << ", detail " << static_cast<int>(settings.detail));
      const auto distances = report->region_distances(*row);
      CHECK((keys_of(distances) == plain.alive));
      CHECK(distances.size() == plain.alive.size());
      CHECK(std::ranges::is_sorted(distances, {}, &RegionDistance::level));
      CHECK(report->statistics().region_distances == distances.size());
      CHECK(report->statistics().region_distances_left_out == 0);
      for (const RegionDistance& line : distances) {
        CHECK(line.vertex_a == indexed(*mesh_a).regions().region(line.region_a).middle);
        CHECK(line.vertex_b == indexed(*mesh_b).regions().region(line.region_b).middle);
        CHECK(line.point_a == at_a[line.vertex_a]);
        CHECK(line.point_b == at_b[line.vertex_b]);
        CHECK(line.distance == Approx((line.point_b - line.point_a).norm()).epsilon(1e-14));
      }
      counts.insert(distances.size());
      compared += distances.size();
    }
    CHECK(counts.size() > 4);
  }
  CHECK(compared > 1000);
  std::cout << "compared " << compared << " distances of regions\n";
}

TEST_CASE("region distances: beyond the cap the deepest are left out, and counted") {
  const auto mesh = mesh_of(models::torus());
  const auto lines_with = [&](std::size_t capacity, unsigned threads) {
    SceneSettings settings = settings_with(ContactDetail::features, capacity);
    settings.threads = threads;
    Scene scene(settings);
    for (int i = 0; i < 3; ++i)
      scene.set_positions(scene.add(mesh), PositionView(moved(mesh->rest(), {1.5 * i, 0, 0})));
    return scene.step();
  };
  const ReportHandle all = lines_with(1'000'000, 1);
  REQUIRE(all->pairs().size() == 2);
  const ReportHandle none = lines_with(0, 1);
  CHECK(none->region_distances().empty());
  for (const std::size_t capacity : {2U, 20U, 200U}) {
    const ReportHandle some = lines_with(capacity, 1);
    CHECK(some->region_distances().size() == capacity);
    CHECK(some->statistics().region_distances_left_out > 0);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto listed = some->region_distances(some->pairs()[i]);
      REQUIRE(listed.size() == capacity / 2);
      const auto whole = all->region_distances(all->pairs()[i]);
      CHECK(keys_of(listed) == keys_of(whole.first(listed.size())));
    }
    const ReportHandle on_threads = lines_with(capacity, 3);
    CHECK(keys_of(on_threads->region_distances()) == keys_of(some->region_distances()));
    // The answer itself knows nothing of it.
    CHECK(some->contacts().size() == none->contacts().size());
  }
}

TEST_CASE("region distances: a large pair lists the same on any number of threads, capped or not") {
  const auto mesh = mesh_of(models::sphere(90, 60));
  REQUIRE(mesh->vertex_count() >= LargePair::least_vertex_count);
  const Positions at_a(mesh->rest().begin(), mesh->rest().end());
  const Positions at_b = moved(mesh->rest(), {0.02, 0.03, 0.01});
  // Shells near each other everywhere: thousands of lines, so that every level below the first has slices.
  const auto step_with = [&](std::size_t capacity, unsigned threads) {
    SceneSettings settings = settings_with(ContactDetail::none, capacity);
    settings.range = 0.1;
    settings.threads = threads;
    Scene scene(settings);
    scene.add(mesh);
    scene.set_positions(scene.add(mesh), PositionView(at_b));
    return scene.step();
  };
  const auto text_of = [](const FrameReport& report) {
    std::ostringstream text;
    text << std::hexfloat << report.statistics().region_distances_left_out << '\n';
    for (const RegionDistance& line : report.region_distances())
      text << line.level << ' ' << line.region_a << ' ' << line.region_b << ' ' << line.distance << '\n';
    return text.str();
  };
  const ReportHandle whole = step_with(1'000'000, 1);
  PlainWalk plain{*mesh, *mesh, at_a, at_b, settings_with(ContactDetail::none, 0), {}};
  plain.settings.range = 0.1;
  plain.visit(0, 0);
  CHECK((keys_of(whole->region_distances()) == plain.alive));
  REQUIRE(plain.alive.size() > 5000);
  for (const std::size_t capacity : {std::size_t{1'000'000}, plain.alive.size() / 2, std::size_t{100}}) {
    const ReportHandle on_one = step_with(capacity, 1);
    CHECK(on_one->region_distances().size() == std::min(capacity, plain.alive.size()));
    CHECK((on_one->statistics().region_distances_left_out > 0) == (capacity < plain.alive.size()));
    for (int repeat = 0; repeat < 3; ++repeat) CHECK(text_of(*step_with(capacity, 4)) == text_of(*on_one));
  }
}

}  // namespace graze::tests
