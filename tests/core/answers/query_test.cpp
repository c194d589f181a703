// query() and RepeatedQuery by themselves: answers of brute force, ranges, what is refused, and that an
// answer depends on the positions of its own call alone. tests/scheduler compares them with a scene.

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/error.hpp>
#include <graze/query.hpp>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "models/models.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/error_of.hpp"
#include "support/mesh_of.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Mesh& cube() {
  static const auto mesh = mesh_of(shape_of(models::box({2, 2, 2})));
  return *mesh;
}

Points moved_by(const Mesh& mesh, const Eigen::Vector3d& offset) {
  Points points(mesh.rest().begin(), mesh.rest().end());
  for (Eigen::Vector3d& point : points) point += offset;
  return points;
}

std::string refusal_of_settings(const QuerySettings& settings) {
  return error_of([&] { (void)query(cube(), cube().rest(), cube(), cube().rest(), settings); });
}

bool is_same(const QueryResult& left, const QueryResult& right) {
  const auto is_same_contact = [](const Contact& one, const Contact& other) {
    return one.kind == other.kind && one.feature_a == other.feature_a && one.feature_b == other.feature_b &&
           one.point_a == other.point_a && one.point_b == other.point_b && one.normal == other.normal &&
           one.distance == other.distance;
  };
  return left.in_contact == right.in_contact && left.is_in_range == right.is_in_range &&
         left.distance.lower == right.distance.lower && left.distance.upper == right.distance.upper &&
         left.witness.point_a == right.witness.point_a && left.witness.point_b == right.witness.point_b &&
         std::ranges::equal(left.contacts, right.contacts, is_same_contact);
}

}  // namespace

TEST_CASE("a query of two random surfaces answers as brute force does, at every detail") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 7000; seed < 7150; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    const auto mesh_a = mesh_of(given.a);
    const auto mesh_b = mesh_of(given.b);
    for (const ContactDetail detail : all_details) {
      const QueryResult result = query(*mesh_a, given.a.positions, *mesh_b, given.b.positions,
                                       {.contact_distance = given.threshold, .detail = detail});
      const Expected expected = expected_of(given.a, given.b, given.threshold, detail);
      const Tolerance tolerance(given.a, given.b);
      INFO("seed " << seed << ", detail " << name_of(detail));
      REQUIRE(result.is_in_range);
      REQUIRE(result.in_contact == expected.in_contact);
      REQUIRE(difference_of(result.contacts, expected.contacts, tolerance) == "");
      REQUIRE(difference_of(result.distance, result.witness, expected.distance, tolerance) == "");
      contacts += result.contacts.size();
    }
  }
  CHECK(contacts > 1000);
}

TEST_CASE("a query without settings gives the distance, and contacts only where an edge pierces") {
  const QueryResult apart = query(cube(), cube().rest(), cube(), moved_by(cube(), {5, 0, 0}));
  CHECK_FALSE(apart.in_contact);
  CHECK(apart.contacts.empty());
  CHECK(apart.distance.lower == 3);
  CHECK(apart.distance.upper == 3);
  const QueryResult crossing = query(cube(), cube().rest(), cube(), moved_by(cube(), {1.5, 0.5, 0.25}));
  CHECK(crossing.in_contact);
  CHECK_FALSE(crossing.contacts.empty());
  CHECK(crossing.distance.upper == 0);
}

TEST_CASE("beyond the range of a query the bounds hold, and the lower one is at least the range") {
  for (const ContactDetail detail : all_details)
    for (const Eigen::Vector3d& offset : {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(2.5, 2.5, 2.5)}) {
      // A tetrahedron leaves much of its box empty, so that the boxes alone do not decide.
      const Mesh tetrahedron =
          Mesh::from_triangles(Points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
                               std::vector<std::array<int, 3>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
      const Points other = moved_by(tetrahedron, offset);
      const auto within = [&](double range) {
        return query(tetrahedron, tetrahedron.rest(), tetrahedron, other, {.range = range, .detail = detail});
      };
      const QueryResult truth = within(infinity);
      REQUIRE(truth.is_in_range);
      const double range = truth.distance.lower * 0.99;
      const QueryResult beyond = within(range);
      CHECK_FALSE(beyond.is_in_range);
      CHECK_FALSE(beyond.in_contact);
      CHECK(beyond.contacts.empty());
      CHECK(beyond.distance.lower >= range);
      CHECK(beyond.distance.lower <= truth.distance.lower);
      CHECK(beyond.distance.upper >= truth.distance.upper);
      CHECK((beyond.witness.point_b - beyond.witness.point_a).norm() <= beyond.distance.upper);
      const QueryResult in_range = within(truth.distance.upper * 1.01);
      CHECK(is_same(in_range, truth));
    }
}

TEST_CASE("the contact distance counts where it is larger than the range") {
  const QueryResult result = query(cube(), cube().rest(), cube(), moved_by(cube(), {2.5, 0, 0}),
                                   {.contact_distance = 1, .range = 0.1});
  CHECK(result.in_contact);
  CHECK(result.is_in_range);
  CHECK_FALSE(result.contacts.empty());
}

TEST_CASE("a query refuses settings in the words of a scene") {
  CHECK(refusal_of_settings({.contact_distance = -1}) ==
        "query: contact_distance is -1; give a distance that is finite and not negative");
  CHECK(refusal_of_settings({.contact_distance = infinity}) ==
        "query: contact_distance is inf; give a distance that is finite and not negative");
  CHECK(refusal_of_settings({.range = not_a_number}) ==
        "query: range is nan; give a distance that is not negative, or infinity");
  CHECK(refusal_of_settings({.detail = static_cast<ContactDetail>(200)})
            .starts_with("query: detail is 200; the last"));
  CHECK(refusal_of_settings({.accuracy = Accuracy::paper()}) ==
        "query: paper accuracy goes with the details `regions` and `vertices` only");
  CHECK(refusal_of_settings({.max_contacts = 0}) ==
        "query: max_contacts is at least 1; ContactDetail::none lists no contacts");
  CHECK(refusal_of_settings({}).empty());
}

TEST_CASE("a query refuses a solid that is not closed, and says which") {
  const Mesh sheet = *mesh_of(shape_of(models::sheet(1, 1, 1, 1)));
  const auto ask = [&](const Mesh& a, const Mesh& b, const QuerySettings& settings) {
    return error_of([&] { RepeatedQuery(a, b, settings); });
  };
  CHECK(ask(sheet, cube(), {.a_is_solid = true}).starts_with("query: surface a: a solid has a closed surf"));
  CHECK(ask(cube(), sheet, {.b_is_solid = true}).starts_with("query: surface b: a solid has a closed surf"));
  CHECK(ask(sheet, cube(), {.b_is_solid = true}).empty());
}

TEST_CASE("a query refuses positions that a scene refuses, and keeps its last result") {
  RepeatedQuery repeated(cube(), cube(), {.contact_distance = 1});
  const Points near = moved_by(cube(), {2.5, 0, 0});
  const Points far = moved_by(cube(), {50, 0, 0});
  const QueryResult before = repeated.ask(cube().rest(), near);
  const QueryResult& kept = repeated.ask(cube().rest(), near);
  const auto refusal = [&](PositionView a, PositionView b) {
    const std::string message = error_of([&] { repeated.ask(a, b); });
    CHECK(is_same(kept, before));
    return message;
  };
  const Points seven(7, Eigen::Vector3d::Zero());
  CHECK(refusal(seven, far) == "query: surface a got 7 positions for 8 vertices");
  CHECK(refusal(far, seven) == "query: surface b got 7 positions for 8 vertices");
  CHECK(refusal(far, PositionView(static_cast<const double*>(nullptr), 8)) ==
        "query: surface b got null memory");
  const std::vector<double> numbers(30, 0.0);
  CHECK(refusal(PositionView(numbers.data(), 8, 20), far) ==
        "query: surface a got memory that is not aligned to its numbers");
  Points bad = near;
  bad[3].y() = not_a_number;
  CHECK(refusal(far, bad).starts_with("query: surface b: vertex 3 is at "));
  bad[3].y() = 0x1p121;
  CHECK(refusal(bad, far).ends_with(", beyond 2^120"));
  CHECK(is_same(repeated.ask(cube().rest(), near), before));
}

TEST_CASE("a repeated query answers as one that is asked once, whatever it was asked before") {
  for (const ContactDetail detail : all_details) {
    const Mesh torus = *mesh_of(shape_of(models::torus(12, 8, 1, 0.4)));
    const Mesh ball = *mesh_of(shape_of(models::sphere(10, 6)));
    const bool is_about_vertices = !is_about_surfaces(detail);
    for (const Accuracy& accuracy : {Accuracy::exact(), Accuracy::within(0.1),
                                     is_about_vertices ? Accuracy::paper() : Accuracy::exact()}) {
      const QuerySettings settings{.contact_distance = 0.2, .detail = detail, .accuracy = accuracy};
      RepeatedQuery repeated(torus, ball, settings);
      for (int step = 0; step < 24; ++step) {
        const double angle = 2.4 * step;
        const Points now =
            moved_by(ball, 2.2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.1 * step));
        INFO("detail " << name_of(detail) << ", step " << step);
        REQUIRE(is_same(repeated.ask(torus.rest(), now), query(torus, torus.rest(), ball, now, settings)));
      }
    }
  }
}

TEST_CASE("a query of floats answers as one of the same numbers in double") {
  const Points doubles = moved_by(cube(), {2.5, 0.25, 0.125});
  std::vector<Eigen::Vector3f> floats;
  for (const Eigen::Vector3d& point : doubles) floats.push_back(point.cast<float>());
  const QuerySettings settings{.contact_distance = 1};
  const QueryResult result = query(cube(), cube().rest(), cube(), floats, settings);
  CHECK(result.in_contact);
  CHECK(is_same(result, query(cube(), cube().rest(), cube(), doubles, settings)));
}

TEST_CASE("threads ask about the same meshes at once") {
  const Mesh ball = *mesh_of(shape_of(models::sphere(10, 6)));
  const Points near = moved_by(ball, {1.9, 0.1, 0.2});
  const QuerySettings settings{.contact_distance = 0.2, .detail = ContactDetail::nearest};
  std::array<QueryResult, 4> results;
  std::vector<std::thread> threads;
  for (QueryResult& result : results)
    threads.emplace_back([&] { result = query(ball, ball.rest(), ball, near, settings); });
  for (std::thread& thread : threads) thread.join();
  const QueryResult alone = query(ball, ball.rest(), ball, near, settings);
  CHECK_FALSE(alone.contacts.empty());
  for (const QueryResult& result : results) CHECK(is_same(result, alone));
}

TEST_CASE("query: a reach that is less than what underflow loses ends") {
  const auto point_at = [](const Eigen::Vector3d& place) {
    return Mesh::from_triangles(std::vector<Eigen::Vector3d>{place}, std::vector<std::uint32_t>{0, 0, 0});
  };
  const Mesh a = point_at({8.8e-280, 9.6e-304, 5.2e-270});
  const Mesh b = point_at({0, 0, 0});
  const QueryResult result = query(a, a.rest(), b, b.rest(), {.range = 2e-289});
  CHECK((!result.in_contact && !result.is_in_range && result.contacts.empty()));
  CHECK((result.distance.lower <= 5.2e-270 && result.distance.upper >= 5.2e-270));
}

}  // namespace graze::tests
