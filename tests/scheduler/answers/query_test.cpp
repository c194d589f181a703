// query() and RepeatedQuery say, bit for bit, what a scene says of the same two objects.

#include <Eigen/Geometry>
#include <cmath>
#include <graze/query.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

SceneSettings scene_settings_of(const QuerySettings& settings) {
  SceneSettings scene = settings_of(settings.contact_distance, settings.range, settings.detail);
  scene.accuracy = settings.accuracy;
  scene.max_contacts_per_pair = settings.max_contacts;
  scene.ways_out = settings.ways_out;
  scene.threads = 1;
  return scene;
}

/// Whether the numbers of an answer are those of a scene's row, in the words of a report.
std::string difference_of(const FrameReport& report, const QueryResult& result) {
  if (report.pairs().empty()) return result.is_in_range ? "the scene does not list the pair" : "";
  if (!result.is_in_range) return "the scene lists the pair";
  const PairReport& row = report.pairs().front();
  const bool in_contact = row.phase == PairPhase::began || row.phase == PairPhase::touching;
  if (result.in_contact != in_contact) return "in contact or not";
  for (const Contact& contact : result.contacts)
    if (contact.since != 0) return "a contact of a query has no frame";
  PairReport same = row;
  same.complete = !result.contacts_cut;
  same.contacts_cut = result.contacts_cut;
  same.inside = result.inside;
  same.distance = result.distance;
  same.witness = result.witness;
  same.way_out = result.way_out;
  const std::string of_scene = text_of(report, row);
  const std::string of_query = text_of(same, result.contacts);
  return of_scene == of_query ? "" : of_scene + "\nand\n" + of_query;
}

/// A scene with the two objects of a query.
struct SceneOfTwo {
  SceneOfTwo(const std::shared_ptr<const Mesh>& mesh_a, const std::shared_ptr<const Mesh>& mesh_b,
             const QuerySettings& settings, Motion motion_of_b = Motion::deformable)
      : scene(scene_settings_of(settings)) {
    ObjectSettings object;
    object.solid = settings.a_is_solid;
    a = scene.add(mesh_a, object);
    object.solid = settings.b_is_solid;
    object.motion = motion_of_b;
    b = scene.add(mesh_b, object);
  }

  Scene scene;
  ObjectId a, b;
};

/// How an answer about two shapes at rest differs from that of a scene. Empty if it does not.
std::string difference_of(const oracle::Shape& a, const oracle::Shape& b, const QuerySettings& settings) {
  const auto mesh_a = mesh_of(a);
  const auto mesh_b = mesh_of(b);
  SceneOfTwo two(mesh_a, mesh_b, settings);
  return difference_of(*two.scene.step(), query(*mesh_a, a.positions, *mesh_b, b.positions, settings));
}

std::vector<QuerySettings> with_all_details(const QuerySettings& settings) {
  std::vector<QuerySettings> all(all_details.size(), settings);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].detail = all_details[i];
  return all;
}

Positions placed_at(const Mesh& mesh, const Eigen::Isometry3d& pose) {
  const Eigen::Matrix4d m = pose.matrix();
  Positions positions;
  for (const Eigen::Vector3d& p : mesh.rest()) {
    Eigen::Vector3d& placed = positions.emplace_back();
    for (int row = 0; row < 3; ++row)
      placed[row] = ((m(row, 0) * p.x() + m(row, 1) * p.y()) + m(row, 2) * p.z()) + m(row, 3);
  }
  return positions;
}

Eigen::Isometry3d pose_of_step(int step) {
  const double angle = 0.3 * step;
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translation() = Eigen::Vector3d(2.8 * std::cos(angle), 0.2, 0.5 * std::sin(2 * angle));
  return pose;
}

}  // namespace

TEST_CASE("a query of two random surfaces has the bits of a scene, at every detail, limit and range") {
  for (std::uint64_t seed = 9000; seed < 9150; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    for (QuerySettings settings : with_all_details({.contact_distance = given.threshold})) {
      INFO("seed " << seed << ", detail " << name_of(settings.detail));
      REQUIRE(difference_of(given.a, given.b, settings) == "");
      settings.ways_out = true;
      settings.max_contacts = 1 + seed % 5;
      REQUIRE(difference_of(given.a, given.b, settings) == "");
      for (const double range : {0.0, 0.1, 0.5}) {
        settings.range = range;
        REQUIRE(difference_of(given.a, given.b, settings) == "");
      }
    }
  }
}

TEST_CASE("a query of two random solids has the bits of a scene, at every detail") {
  std::size_t ways_out = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const oracle::RandomSolids given = oracle::random_solids(seed);
    for (QuerySettings settings : with_all_details({.contact_distance = given.threshold,
                                  .a_is_solid = given.solids.a,
                                  .b_is_solid = given.solids.b,
                                  .ways_out = true})) {
      INFO("seed " << seed << ", detail " << name_of(settings.detail));
      REQUIRE(difference_of(given.a, given.b, settings) == "");
      settings.max_contacts = 2;
      REQUIRE(difference_of(given.a, given.b, settings) == "");
      const auto mesh_a = mesh_of(given.a);
      const auto mesh_b = mesh_of(given.b);
      ways_out += query(*mesh_a, mesh_a->rest(), *mesh_b, mesh_b->rest(), settings).way_out.fullness > 0;
    }
  }
  CHECK(ways_out > 50);
}

TEST_CASE("a query in paper mode has the bits of a scene") {
  for (std::uint64_t seed = 9200; seed < 9300; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    INFO("seed " << seed);
    for (const ContactDetail detail : {ContactDetail::regions, ContactDetail::vertices})
      for (const Accuracy& accuracy : {Accuracy::paper(), Accuracy::paper({1, 0.5, 0.25})})
        for (const double range : {infinity, 0.4})
          REQUIRE(difference_of(
                      given.a, given.b,
                      {.contact_distance = 0.3, .range = range, .detail = detail, .accuracy = accuracy}) ==
                  "");
  }
}

TEST_CASE("within a tolerance the bounds of a query hold, and its contacts have the bits of a scene") {
  constexpr double tolerance = 0.125;
  std::size_t loose = 0;
  for (std::uint64_t seed = 9300; seed < 9400; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    for (QuerySettings settings : with_all_details({.contact_distance = given.threshold})) {
      const auto mesh_a = mesh_of(given.a);
      const auto mesh_b = mesh_of(given.b);
      SceneOfTwo two(mesh_a, mesh_b, settings);
      settings.accuracy = Accuracy::within(tolerance);
      const QueryResult result = query(*mesh_a, given.a.positions, *mesh_b, given.b.positions, settings);
      const ReportHandle exact = two.scene.step();
      const DistanceBounds truth = only_pair(*exact).distance;
      INFO("seed " << seed << ", detail " << name_of(settings.detail));
      if (result.in_contact) REQUIRE(difference_of(*exact, result) == "");
      REQUIRE(result.in_contact == (only_pair(*exact).phase == PairPhase::began));
      REQUIRE(result.distance.lower <= truth.lower);
      REQUIRE(result.distance.upper >= truth.upper);
      REQUIRE(result.distance.upper - result.distance.lower <= tolerance + 0x1p-40);
      loose += result.distance.upper > truth.upper || result.distance.lower < truth.lower;
    }
  }
  CHECK(loose > 20);
}

TEST_CASE("a repeated query has the bits of a scene in each of many steps, at every detail") {
  const auto ball = mesh_of(models::sphere(16, 8));
  const auto torus = mesh_of(models::torus(20, 10, 1, 0.4));
  for (const QuerySettings& settings : with_all_details(
           {.contact_distance = 0.1, .a_is_solid = true, .b_is_solid = true, .ways_out = true})) {
    SceneOfTwo two(torus, ball, settings);
    RepeatedQuery repeated(*torus, *ball, settings);
    std::size_t in_contact = 0;
    for (int step = 0; step < 20; ++step) {
      const Positions now = placed_at(*ball, pose_of_step(step));
      two.scene.set_positions(two.b, now);
      INFO("detail " << name_of(settings.detail) << ", step " << step);
      const QueryResult& result = repeated.ask(torus->rest(), now);
      REQUIRE(difference_of(*two.scene.step(), result) == "");
      in_contact += result.in_contact;
    }
    CHECK(in_contact > 5);
    CHECK(in_contact < 20);
  }
}

TEST_CASE("a rigid body placed by set_pose's formula has the same answers from a query") {
  const auto ball = mesh_of(models::sphere(16, 8));
  const auto box = mesh_of(models::box({2, 2, 1}));
  const QuerySettings settings{
      .contact_distance = 0.1, .detail = ContactDetail::nearest, .a_is_solid = true, .b_is_solid = true};
  SceneOfTwo two(ball, box, settings, Motion::rigid);
  RepeatedQuery repeated(*ball, *box, settings);
  for (int step = 0; step < 20; ++step) {
    two.scene.set_pose(two.b, pose_of_step(step));
    INFO("step " << step);
    const QueryResult& result = repeated.ask(ball->rest(), placed_at(*box, pose_of_step(step)));
    REQUIRE(difference_of(*two.scene.step(), result) == "");
  }
}

}  // namespace graze::tests
