// Queries between steps: what they see of a report, against the scene's own answers and plain loops over all
// objects, while the scene steps on, and after it is gone. tests/core has the exact oracles of one surface.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <graze/graze.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/error_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;

Eigen::Isometry3d pose_at(const Eigen::Vector3d& place) {
  return Eigen::Isometry3d(Eigen::Translation3d(place));
}

std::shared_ptr<const Mesh> cube_mesh() {
  static const auto mesh = mesh_of(models::box({1, 1, 1}));
  return mesh;
}

/// Cubes at random places that all ask for queries, and move.
struct AskingCubes {
  explicit AskingCubes(std::uint64_t seed, std::size_t count, SceneSettings settings = {})
      : random(seed), scene(settings) {
    for (std::size_t i = 0; i < count; ++i) {
      ObjectSettings object;
      object.motion = Motion::rigid;
      object.layer = 1U << random.below(3);
      object.collides_with = 1 + random.below(7);
      object.solid = true;
      object.queries = true;
      ids.push_back(scene.add(cube_mesh(), object));
      settings_of_object.push_back(object);
      move(i);
    }
  }
  void move(std::size_t index) { scene.set_pose(ids[index], pose_at(random.vector(-8, 8))); }
  [[nodiscard]] bool counts(std::size_t index, const QueryFilter& filter) const {
    const ObjectSettings& object = settings_of_object[index];
    return (object.layer & filter.collides_with) != 0 && (object.collides_with & filter.layer) != 0 &&
           ids[index] != filter.ignored;
  }
  QueryFilter some_filter() {
    QueryFilter filter;
    if (random.chance(0.5)) filter.layer = 1U << random.below(3);
    if (random.chance(0.5)) filter.collides_with = 1 + random.below(7);
    if (random.chance(0.5)) filter.ignored = ids[random.below(static_cast<std::uint32_t>(ids.size()))];
    return filter;
  }
  [[nodiscard]] Eigen::Vector3d middle(const FrameReport& report, std::size_t index) const {
    const PositionView positions = report.positions(ids[index]);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::uint32_t i = 0; i < positions.size(); ++i) sum += positions[i];
    return sum / positions.size();
  }

  Random random;
  Scene scene;
  std::vector<ObjectId> ids;
  std::vector<ObjectSettings> settings_of_object;
};

/// The distance of a point from the surface of a cube of side 1.
double distance_from_cube(const Eigen::Vector3d& middle, const Eigen::Vector3d& point) {
  const Eigen::Array3d off = (point - middle).array().abs() - 0.5;
  return (off < 0).all() ? -off.maxCoeff() : off.max(0).matrix().norm();
}

/// Where a line enters and leaves a cube of side 1.
std::optional<std::array<double, 2>> crossings_of_cube(const Eigen::Vector3d& middle,
                                                       const Eigen::Vector3d& origin,
                                                       const Eigen::Vector3d& way) {
  std::array<double, 2> range{-1e9, 1e9};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (middle[axis] - 0.5 - origin[axis]) / way[axis];
    const double high = (middle[axis] + 0.5 - origin[axis]) / way[axis];
    range = {std::max(range[0], std::min(low, high)), std::min(range[1], std::max(low, high))};
  }
  if (range[0] > range[1]) return std::nullopt;
  return range;
}

}  // namespace

TEST_CASE("queries of many objects find what a loop over all objects finds") {
  constexpr std::size_t count = 60;
  AskingCubes cubes(1, count);
  SceneQuery query;
  std::size_t hits_in_all = 0;
  std::size_t touches_in_all = 0;
  for (std::uint64_t step = 0; step < repeats(200); ++step) {
    for (int moves = 0; moves < 5; ++moves) cubes.move(cubes.random.below(count));
    query.set_report(cubes.scene.step());
    const QueryFilter filter = cubes.some_filter();
    const Eigen::Vector3d point = cubes.random.vector(-9, 9);
    const Eigen::Vector3d to = cubes.random.vector(-9, 9);
    std::vector<double> distances;
    std::vector<double> crossings;
    std::vector<Eigen::Vector3d> middles;
    std::vector<ObjectId> in_box;
    for (std::size_t i = 0; i < count; ++i) {
      if (!cubes.counts(i, filter)) continue;
      const Eigen::Vector3d middle = cubes.middle(*query.report(), i);
      middles.push_back(middle);
      distances.push_back(distance_from_cube(middle, point));
      if (((middle - point).array().abs() <= 2.5).all()) in_box.push_back(cubes.ids[i]);
      if (const auto range = crossings_of_cube(middle, point, to - point))
        for (const double t : *range)
          if (t >= 0) crossings.push_back(t);
    }
    std::sort(distances.begin(), distances.end());
    std::sort(crossings.begin(), crossings.end());
    CAPTURE(step);

    std::array<ClosestPoint, 4> closest;
    const std::size_t closest_count = query.closest_points(point, 1e9, closest, filter);
    REQUIRE(closest_count == std::min(distances.size(), closest.size()));
    for (std::size_t i = 0; i < closest_count; ++i)
      REQUIRE(std::abs(closest[i].distance - distances[i]) < 1e-12);

    std::array<RayHit, 5> hits;
    const std::size_t hit_count = query.cast_ray(point, to - point, 1e9, hits, filter);
    REQUIRE(hit_count == std::min(crossings.size(), hits.size()));
    for (std::size_t i = 0; i < hit_count; ++i) {
      REQUIRE(std::abs(hits[i].t - crossings[i]) < 1e-9);
      REQUIRE(std::abs(hits[i].normal.norm() - 1) < 1e-12);
    }
    hits_in_all += hit_count;

    constexpr double radius = 0.5;
    const auto touch = query.cast_sphere(point, to, radius, filter);
    const double until = touch ? touch->t : 1;
    double nearest_before = 1e9;
    for (const Eigen::Vector3d& middle : middles)
      for (int sample = 0; sample < 50; ++sample)
        nearest_before = std::min(nearest_before,
                                  distance_from_cube(middle, point + (to - point) * (until * sample / 50)));
    REQUIRE((until == 0 || nearest_before > radius - 1e-9));
    if (touch && touch->t > 0) {
      ++touches_in_all;
      REQUIRE(std::abs((touch->centre - touch->point).norm() - radius) < 1e-9);
      REQUIRE((touch->centre - touch->point - radius * touch->normal).norm() < 1e-9);
    }

    std::array<ObjectId, count> listed;
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(2);
    const std::size_t listed_count = query.objects_in_box(point - reach, point + reach, listed, filter);
    REQUIRE(std::vector(listed.begin(), listed.begin() + static_cast<std::ptrdiff_t>(listed_count)) ==
            in_box);
  }
  REQUIRE(hits_in_all > repeats(40));
  REQUIRE(touches_in_all > repeats(20));
}

TEST_CASE("a probe is blocked by the objects that it would be in contact with in a scene") {
  constexpr std::size_t count = 30;
  constexpr double clearance = 0.25;
  AskingCubes cubes(2, count, settings_of(clearance, 0));
  const auto small = mesh_of(models::box({0.25, 0.25, 0.25}));
  ObjectSettings settings = motion_of(Motion::rigid);
  settings.solid = true;
  const ObjectId body = cubes.scene.add(small, settings);
  MeshProbe probe(small, true);
  SceneQuery query;
  std::size_t blocked = 0;
  for (std::uint64_t step = 0; step < repeats(300); ++step) {
    cubes.move(cubes.random.below(count));
    Eigen::Isometry3d pose = pose_at(cubes.random.vector(-6, 6));
    if (step % 3 == 0)  // inside of a cube
      pose = pose_at(cubes.middle(*cubes.scene.step(), cubes.random.below(count)));
    pose.linear() = cubes.random.turn();
    cubes.scene.set_pose(body, pose);
    probe.set_pose(pose);
    query.set_report(cubes.scene.step());
    std::vector<ObjectId> expected;
    for (const PairReport& pair : query.report()->pairs())
      if (pair.b == body && (pair.phase == PairPhase::began || pair.phase == PairPhase::touching))
        expected.push_back(pair.a);
    std::array<ObjectId, count> found;
    QueryFilter filter;
    filter.layer = settings.layer;
    const std::size_t found_count = query.blocking(probe, clearance, found, filter);
    CAPTURE(step);
    REQUIRE(std::vector(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found_count)) == expected);
    REQUIRE(query.is_free(probe, clearance, filter) == expected.empty());
    blocked += found_count;
  }
  REQUIRE(blocked > repeats(40));
}

TEST_CASE("a report keeps meshes, and positions of the objects that ask, after changes and after the scene") {
  auto scene = std::make_unique<Scene>(SceneSettings{});
  ObjectSettings asks = motion_of(Motion::deformable);
  asks.queries = true;
  const auto plate = plate_mesh();
  const ObjectId moving = scene->add(plate, asks);
  const ObjectId resting = scene->add(cube_mesh(), asks);
  const auto silent_mesh = plate_mesh();
  const ObjectId silent = scene->add(silent_mesh, motion_of(Motion::deformable));
  REQUIRE(scene->latest_report()->mesh(moving) == nullptr);
  scene->set_positions(moving, lifted(*plate, 1));
  const ReportHandle first = scene->step();
  scene->set_positions(moving, lifted(*plate, 2));
  const ReportHandle second = scene->step();
  const ReportHandle third = scene->step();
  std::vector<std::uint32_t> new_of_old(plate->vertex_count(), Mesh::no_vertex);
  scene->replace_mesh(moving, needle_mesh(), new_of_old);
  const ReportHandle fourth = scene->step();
  scene->remove(moving);
  const ReportHandle fifth = scene->step();
  const FrameReport copy = *second;
  REQUIRE((copy.mesh(moving) == plate && copy.mesh(silent) == silent_mesh));

  REQUIRE((first->mesh(silent) == silent_mesh && first->positions(silent).size() == 0));
  REQUIRE(first->mesh(moving) == plate);
  REQUIRE(first->positions(moving)[0].z() == 1);
  REQUIRE(second->positions(moving)[0].z() == 2);
  REQUIRE(second->positions(moving).data() == third->positions(moving).data());
  REQUIRE(second->positions(resting).data() == fifth->positions(resting).data());
  REQUIRE(fourth->mesh(moving)->vertex_count() == needle_mesh()->vertex_count());
  REQUIRE((fifth->mesh(moving) == nullptr && fifth->mesh(resting) != nullptr));

  scene.reset();
  SceneQuery query(first);
  const auto hit = query.cast_ray({0.5, 0.25, 5}, {0, 0, -1}, 10, {.ignored = resting});
  REQUIRE((hit && hit->object == moving && hit->t == 4 && hit->feature.kind == FeatureKind::face));
  query.set_report(fifth);
  REQUIRE(!query.cast_ray({0.5, 0.25, 5}, {0, 0, -1}, 10, {.ignored = resting}));
  REQUIRE(copy.positions(moving)[0].z() == 2);
}

TEST_CASE("reports know the mesh of each of many objects that come, go and change") {
  Random random(3);
  Scene scene({.threads = 1});
  std::vector<std::pair<ObjectId, std::shared_ptr<const Mesh>>> there;
  std::vector<ObjectId> gone;
  std::vector<ReportHandle> reports;
  std::vector<decltype(there)> expected;
  for (std::uint64_t step = 0; step < std::max<std::uint64_t>(30, repeats(300)); ++step) {
    for (std::uint32_t adding = random.below(40); adding > 0; --adding) {
      const auto mesh = random.chance(0.5) ? plate_mesh() : needle_mesh();
      there.emplace_back(scene.add(mesh, {.motion = Motion::fixed, .collides_with = 0}), mesh);
    }
    for (std::uint32_t taking = random.below(30); taking > 0 && !there.empty(); --taking) {
      const auto taken = there.begin() + random.below(static_cast<std::uint32_t>(there.size()));
      scene.remove(taken->first);
      gone.push_back(taken->first);
      there.erase(taken);
    }
    if (!there.empty() && random.chance(0.5)) {
      auto& [id, mesh] = there[random.below(static_cast<std::uint32_t>(there.size()))];
      const std::vector<std::uint32_t> lost(mesh->vertex_count(), Mesh::no_vertex);
      mesh = cube_mesh();
      scene.replace_mesh(id, mesh, lost);
    }
    reports.push_back(scene.step());
    expected.push_back(there);
    if (reports.size() > 4) {
      reports.erase(reports.begin());
      expected.erase(expected.begin());
    }
    for (std::size_t i = 0; i < reports.size(); ++i)
      for (const auto& [id, mesh] : expected[i]) REQUIRE(reports[i]->mesh(id) == mesh);
    for (const ObjectId id : gone) REQUIRE(reports.back()->mesh(id) == nullptr);
  }
  REQUIRE(gone.size() > 100);
}

TEST_CASE("a scene lets go of the mesh of an object that is gone, once no report has it") {
  Scene scene({.threads = 1});
  auto mesh = std::make_shared<const Mesh>(*cube_mesh());
  const std::weak_ptr<const Mesh> watched = mesh;
  const ObjectId cube = scene.add(std::move(mesh), {});
  scene.add(plate_mesh(), {});
  scene.step();
  scene.remove(cube);
  scene.step();
  scene.step();
  scene.step();
  REQUIRE(watched.expired());
}

TEST_CASE("threads query reports while the scene steps") {
  Scene scene({.threads = 2});
  ObjectSettings asks = motion_of(Motion::deformable);
  asks.queries = true;
  const ObjectId plate = scene.add(plate_mesh(), asks);
  scene.add(cube_mesh(), {.motion = Motion::fixed, .queries = true});
  std::atomic<bool> is_done = false;
  std::atomic<std::uint64_t> wrong = 0;
  std::atomic<std::uint64_t> asked = 0;
  const auto read = [&] {
    SceneQuery query;
    std::optional<FrameReport> copy;
    while (!is_done) {
      query.set_report(scene.latest_report());
      const auto frame = static_cast<double>(query.report()->frame());
      if (frame == 0) continue;
      const auto hit = query.cast_ray({0.75, 0.75, 1e4}, {0, 0, -1});
      if (!hit || hit->object != plate || hit->t != 1e4 - frame - 1) ++wrong;
      const auto closest = query.closest_point({0.75, 0.75, 1e4});
      if (!closest || closest->distance != 1e4 - frame - 1) ++wrong;
      copy = *query.report();
      if (copy->positions(plate)[0].z() != frame + 1) ++wrong;
      ++asked;
    }
  };
  std::thread first(read);
  std::thread second(read);
  std::vector<ReportHandle> held;
  for (int step = 1; step <= 300 || asked < 20; ++step) {
    scene.set_positions(plate, lifted(*plate_mesh(), step + 1));
    if (held.size() > 10) held.erase(held.begin());
    held.push_back(scene.step());
  }
  is_done = true;
  first.join();
  second.join();
  REQUIRE(wrong == 0);
}

TEST_CASE("queries refuse numbers that mean nothing, and know no objects without a report") {
  SceneQuery query;
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(!query.cast_ray({0, 0, 0}, {1, 0, 0}));
  REQUIRE(!query.closest_point({0, 0, 0}));
  REQUIRE(error_of([&] { (void)query.cast_ray({0, 0, 0}, {0, 0, 0}); }) != "");
  REQUIRE(error_of([&] { (void)query.cast_ray({0, not_a_number, 0}, {0, 0, 1}); }) != "");
  REQUIRE(error_of([&] { (void)query.cast_ray({0, 0, 0}, {0, 0, 1}, -1); }) != "");
  REQUIRE(error_of([&] { (void)query.cast_sphere({0, 0, 0}, {0, 0, 1}, -1); }) != "");
  REQUIRE(error_of([&] { (void)query.objects_in_box({0, 0, 0}, {0, 0, -1}, {}); }) != "");
  REQUIRE(error_of([&] { MeshProbe(plate_mesh(), true); }) != "");
  MeshProbe probe(plate_mesh());
  REQUIRE(query.is_free(probe, 0));
  Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
  mirror.linear()(0, 0) = -1;
  REQUIRE(error_of([&] { probe.set_pose(mirror); }) != "");
}

}  // namespace graze::tests
