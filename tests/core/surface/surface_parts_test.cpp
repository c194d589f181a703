// A surface that is read and refitted in parts, in any order, is the one that is read and refitted whole.

#include <algorithm>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <limits>
#include <tuple>
#include <vector>

#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

struct Range {
  std::uint32_t begin;
  std::uint32_t end;
};

/// Ranges that make up 0 … count - 1, in a random order.
std::vector<Range> random_ranges(std::uint32_t count, oracle::Random& random) {
  std::vector<Range> ranges;
  for (std::uint32_t begin = 0; begin < count;) {
    const std::uint32_t end = std::min(count, begin + 1 + random.below(40));
    ranges.push_back({begin, end});
    begin = end;
  }
  for (std::size_t i = ranges.size(); i > 1; --i)
    std::swap(ranges[i - 1], ranges[random.below(static_cast<std::uint32_t>(i))]);
  return ranges;
}

/// Looks and writes in a random order, and puts together in that of the vertices.
template <typename LookAt, typename Write>
Surface::ReadResult read_in_parts(Surface& surface, oracle::Random& random, const LookAt& look_at,
                                  const Write& write) {
  const std::uint32_t count = surface.mesh().vertex_count();
  std::vector<std::pair<std::uint32_t, Surface::PartSeen>> parts;
  for (const Range& range : random_ranges(count, random))
    parts.emplace_back(range.begin, look_at(range.begin, range.end));
  std::sort(parts.begin(), parts.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  Surface::PartSeen all;
  for (const auto& [begin, part] : parts) all.add(part);
  const Surface::ReadResult result = surface.accept(all);
  if (result.changed)
    for (const Range& range : random_ranges(count, random)) write(range.begin, range.end);
  return result;
}

template <typename Points>
Surface::ReadResult read_positions_in_parts(Surface& surface, const Points& positions, oracle::Random& random,
                                            Surface::Displacement displacement) {
  return read_in_parts(
      surface, random,
      [&](std::uint32_t begin, std::uint32_t end) {
        return surface.scan_positions(positions, begin, end, displacement);
      },
      [&](std::uint32_t begin, std::uint32_t end) { surface.write_positions(positions, begin, end); });
}

void refit_in_parts(Surface& surface, RefitOf what, oracle::Random& random) {
  surface.begin_refit(what);
  for (const Range& range : random_ranges(surface.mesh().regions().region_count(), random))
    surface.refit_regions(what, range.begin, range.end);
  surface.finish_refit(what);
}

bool is_same(const Box& p, const Box& q) {
  return p.min == q.min && p.max == q.max;
}

void check_same(const Surface::ReadResult& parts, const Surface::ReadResult& whole) {
  CHECK(parts.bad_vertex == whole.bad_vertex);
  CHECK(parts.displacement == whole.displacement);
}

void check_same(const Surface& parts, const Surface& whole) {
  const auto same_boxes = [](std::span<const Box> p, std::span<const Box> q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), is_same);
  };
  for (std::uint32_t vertex = 0; vertex < whole.mesh().vertex_count(); ++vertex)
    if (whole.mesh().is_used(vertex)) CHECK(parts.position(vertex) == whole.position(vertex));
  CHECK(is_same(parts.box(), whole.box()));
  CHECK(parts.version() == whole.version());
  CHECK(parts.travel().epoch == whole.travel().epoch);
  CHECK(parts.travel().distance == whole.travel().distance);
  CHECK(parts.motion_since_vertex_refit() == whole.motion_since_vertex_refit());
  CHECK(parts.motion_since_face_refit() == whole.motion_since_face_refit());
  CHECK(std::ranges::equal(parts.radii(), whole.radii()));
  CHECK(std::ranges::equal(parts.level_radii(), whole.level_radii()));
  CHECK(same_boxes(parts.vertex_boxes(), whole.vertex_boxes()));
  CHECK(same_boxes(parts.face_boxes(), whole.face_boxes()));
}

}  // namespace

TEST_CASE("a surface in parts: read by several tasks as by one") {
  std::size_t vertices = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    oracle::Random random(seed);
    // Some vertices of a soup are unused and NaN, so that whole parts may have nothing to read.
    const oracle::Shape shape = random_soup(seed, 300, 120);
    Surface parts(mesh_of(shape));
    Surface whole(mesh_of(shape));
    for (int frame = 0; frame < 4; ++frame) {
      const oracle::Shape moved = mapped(shape, 1 + 0.01 * frame, Eigen::Vector3d(0.1 * frame, 0, 0));
      check_same(read_positions_in_parts(parts, moved.positions, random, Surface::Displacement::exact),
                 whole.set_positions(moved.positions));
      const std::uint32_t count = whole.mesh().vertex_count();
      CHECK(is_same(Surface::survey(whole.mesh(), moved.positions, 0, count).box, whole.box()));
      for (const RefitOf what : {RefitOf::vertices, RefitOf::faces, RefitOf::radii})
        refit_in_parts(parts, what, random);
      whole.refit_vertices();
      whole.refit(RefitOf::radii);
      whole.refit_faces();
      check_same(parts, whole);
      vertices += moved.positions.size();
    }
    const std::array<double, 12> pose{0, -1, 0, 0.5, 1, 0, 0, 0.25, 0, 0, 1, -4};
    check_same(read_in_parts(
                   parts, random,
                   [&](std::uint32_t begin, std::uint32_t end) { return parts.scan_pose(pose, begin, end); },
                   [&](std::uint32_t begin, std::uint32_t end) { parts.write_pose(pose, begin, end); }),
               whole.set_pose(pose));
    check_same(parts, whole);
  }
  std::cout << "compared " << vertices << " vertices\n";
}

TEST_CASE("a surface in parts: the first bad vertex is named and no position is accepted") {
  const oracle::Shape shape = shape_of(models::sphere(20, 20));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    oracle::Random random(seed);
    Surface parts(mesh_of(shape));
    Surface whole(mesh_of(shape));
    oracle::Shape moved = mapped(shape, 2, Eigen::Vector3d::Zero());
    for (int bad = 0; bad < 3; ++bad)
      moved.positions[random.below(static_cast<std::uint32_t>(moved.positions.size()))].y() =
          bad == 1 ? 0x1p121 : std::numeric_limits<double>::quiet_NaN();
    const auto displacement = seed % 2 == 0 ? Surface::Displacement::exact : Surface::Displacement::bound;
    const Surface::ReadResult result = read_positions_in_parts(parts, moved.positions, random, displacement);
    CHECK_FALSE(result.taken());
    CHECK_FALSE(result.changed);
    check_same(result, whole.set_positions(moved.positions));
    check_same(parts, whole);
  }
}

TEST_CASE(
    "a surface in parts: in another precision, a bound of the motion is none, and all positions are "
    "accepted") {
  const oracle::Shape shape = shape_of(models::sphere(20, 20));
  Surface surface(mesh_of(shape));
  Surface expected(mesh_of(shape));
  std::vector<Eigen::Vector3f> positions;
  for (const Eigen::Vector3d& position : shape.positions)
    positions.emplace_back((1.25 * position).cast<float>());
  const std::uint32_t count = surface.mesh().vertex_count();
  const Travel before = surface.travel();
  for (int times = 0; times < 2; ++times) {
    const auto seen = surface.scan_positions(positions, 0, count, Surface::Displacement::bound);
    const Surface::ReadResult result = surface.accept(seen);
    REQUIRE(result.taken());
    CHECK(result.changed == (times == 0));
    CHECK(result.displacement == (times == 0 ? std::numeric_limits<double>::infinity() : 0));
    if (result.changed) surface.write_positions(positions, 0, count);
    expected.set_positions(positions);
    for (std::uint32_t vertex = 0; vertex < count; ++vertex)
      CHECK(surface.position(vertex) == expected.position(vertex));
    CHECK(is_same(surface.box(), expected.box()));
    CHECK(surface.version() == expected.version());
  }
  CHECK(surface.motion_since(before) == std::numeric_limits<double>::infinity());
  CHECK(surface.displacement() == 0);
  // Exactly where that is asked for, and none of it where a position is bad.
  Surface exact(mesh_of(shape));
  CHECK(std::isfinite(exact.accept(exact.scan_positions(positions, 0, count)).displacement));
  positions[7].x() = std::numeric_limits<float>::quiet_NaN();
  Surface bad(mesh_of(shape));
  CHECK(bad.scan_positions(positions, 0, count, Surface::Displacement::bound).bad_vertex == 7);
}

namespace {

/// Positions at random, some where they were before, some coordinates huge, tiny or -0.
template <typename Number>
std::vector<Eigen::Matrix<Number, 3, 1>> moved_somehow(std::vector<Eigen::Matrix<Number, 3, 1>> positions,
                                                       oracle::Random& random) {
  const bool some_move = random.chance(0.8);
  for (auto& position : positions)
    for (int axis = 0; axis < 3; ++axis) {
      if (!some_move || random.chance(0.3)) continue;
      const int scale = random.chance(0.1) ? static_cast<int>(random.below(200)) - 100 : 0;
      position[axis] = static_cast<Number>(std::ldexp(random.between(-1, 1), scale));
      if (random.chance(0.05)) position[axis] = Number(-0.0);
    }
  return positions;
}

/// Fast passes in the surface's own layout against going through the vertices one by one.
template <typename Number>
std::size_t check_one_pass(std::uint64_t seed) {
  oracle::Random random(seed);
  const std::uint32_t rows = 2 + random.below(9);
  const oracle::Shape rest = shape_of(models::sheet(rows, 2 + random.below(9), 1, 1));
  Surface surface(mesh_of(rest));
  std::vector<Eigen::Matrix<Number, 3, 1>> positions;
  for (const Eigen::Vector3d& point : rest.positions) positions.push_back(point.cast<Number>() * Number(1.1));
  surface.set_positions(positions);
  const auto count = static_cast<std::uint32_t>(positions.size());
  const auto next = moved_somehow(positions, random);
  const std::uint32_t begin = random.below(count);
  const std::uint32_t end = begin + 1 + random.below(count - begin);
  std::vector<Eigen::Matrix<Number, 4, 1>> apart;  // no fast pass is for this layout
  for (const auto& position : next) apart.emplace_back(position.homogeneous());
  const PositionView one_by_one(apart[0].data(), apart.size(), sizeof apart[0]);
  const auto exact = surface.scan_positions(one_by_one, begin, end);
  CHECK(exact.bad_vertex == Surface::ReadResult::no_vertex);
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    const auto bound = surface.scan_positions(next, begin, end, Surface::Displacement::bound);
    CHECK(is_same(bound.box, exact.box));
    CHECK(bound.changed == exact.changed);
    CHECK(bound.in_double == exact.in_double);
    const double furthest = std::sqrt(exact.furthest_squared);
    CHECK(bound.furthest_squared == 0);  // it is the fast pass that looked
    const auto fast = surface.scan_positions(next, begin, end);
    CHECK(is_same(fast.box, exact.box));
    CHECK(fast.changed == exact.changed);
    CHECK(fast.furthest_squared == exact.furthest_squared);
    CHECK(fast.furthest.isZero());
    CHECK(bound.furthest.norm() >= furthest * (1 - 0x1p-50));
    CHECK(bound.furthest.norm() <= furthest * std::sqrt(3.0) * (1 + 0x1p-20));
    // A bad coordinate anywhere is found, and the vertex named.
    auto bad = next;
    const std::uint32_t vertex = begin + random.below(end - begin);
    const Number worst[] = {std::numeric_limits<Number>::quiet_NaN(),
                            -std::numeric_limits<Number>::infinity(), static_cast<Number>(0x1.000002p120)};
    bad[vertex][static_cast<int>(random.below(3))] = worst[random.below(3)];
    CHECK(surface.scan_positions(bad, begin, end, Surface::Displacement::bound).bad_vertex == vertex);
    CHECK(is_same(Surface::survey(surface.mesh(), next, begin, end).box, exact.box));
    CHECK(is_same(Surface::survey(surface.mesh(), one_by_one, begin, end).box, exact.box));
    const auto surveyed = Surface::survey(surface.mesh(), bad, begin, end);
    CHECK(surveyed.bad_vertex == vertex);
  }
  use_instruction_set(available_instruction_sets().back());
  return end - begin;
}

}  // namespace

TEST_CASE("a surface in parts: one pass sees what a look at every vertex does, with every instruction set") {
  std::size_t vertices = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    vertices += check_one_pass<float>(seed);
    vertices += check_one_pass<double>(seed);
  }
  std::cout << "compared " << vertices << " vertices with " << available_instruction_sets().size()
            << " instruction sets\n";
}

TEST_CASE("a surface in parts: positions are kept in the precision in which they come") {
  const oracle::Shape rest = shape_of(models::sphere(20, 20));
  std::vector<Eigen::Vector3f> floats;
  for (const Eigen::Vector3d& point : rest.positions) floats.push_back(point.cast<float>() * 1.1F);
  Surface surface(mesh_of(rest));
  const std::size_t at_rest = surface.byte_count();
  const auto check = [&](const auto& positions) {
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex)
      CHECK(surface.position(vertex) == positions[vertex].template cast<double>());
  };
  // The positions of the mesh at rest take no memory of the surface's own.
  check(rest.positions);
  CHECK_FALSE(surface.set_positions(rest.positions).changed);
  CHECK(surface.byte_count() == at_rest);
  surface.set_positions(floats);
  check(floats);
  CHECK(surface.byte_count() == at_rest + 12 * floats.size());
  // Setting equal numbers in double does not count as motion.
  std::vector<Eigen::Vector3d> doubles;
  for (const Eigen::Vector3f& point : floats) doubles.push_back(point.cast<double>());
  const std::uint64_t version = surface.version();
  CHECK_FALSE(surface.set_positions(doubles).changed);
  CHECK(surface.version() == version);
  doubles[7].x() += 0x1p-40;
  CHECK(surface.set_positions(doubles).changed);
  check(doubles);
  CHECK(surface.byte_count() == at_rest + 24 * doubles.size());
}

TEST_CASE(
    "a surface in parts: equal numbers in another precision are no motion, also where a bound is wanted") {
  const oracle::Shape rest = shape_of(models::sphere(20, 20));
  Surface surface(mesh_of(rest));
  std::vector<Eigen::Vector3f> floats;
  std::vector<Eigen::Vector3d> doubles;
  for (const Eigen::Vector3d& point : rest.positions) {
    floats.push_back(point.cast<float>());
    doubles.push_back(floats.back().cast<double>());
  }
  surface.set_positions(floats);
  const std::uint32_t count = surface.mesh().vertex_count();
  const std::uint64_t version = surface.version();
  const auto scan = [&](std::uint32_t begin, std::uint32_t end) {
    return surface.scan_positions(doubles, begin, end, Surface::Displacement::bound);
  };
  CHECK_FALSE(scan(0, count).changed);
  const Surface::ReadResult result = surface.accept(scan(0, count));
  CHECK_FALSE(result.changed);
  CHECK(result.displacement == 0);
  CHECK(surface.version() == version);
  CHECK(surface.positions().is_double() == false);
  // One other number is a change of the part that holds it, and so of all.
  doubles.back().z() = -doubles.back().z();
  const std::uint32_t middle = count / 2;
  Surface::PartSeen all = scan(0, middle);
  CHECK_FALSE(all.changed);
  CHECK(scan(middle, count).changed);
  all.add(scan(middle, count));
  CHECK(surface.accept(all).changed);
  CHECK(surface.displacement() == std::numeric_limits<double>::infinity());
  surface.write_positions(doubles, 0, count);
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) CHECK(surface.position(vertex) == doubles[vertex]);
}

}  // namespace graze::tests
