// A surface that is read and refitted in parts, in any order, is the one that is read and refitted whole.

#include <algorithm>
#include <graze/surface.hpp>
#include <iostream>
#include <limits>
#include <vector>

#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/random_scenes.hpp"

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

/// Reads in a random order, and puts together in that of the vertices.
template <typename ReadPart>
Surface::ReadResult read_in_parts(Surface& surface, oracle::Random& random, const ReadPart& read_part) {
  std::vector<std::pair<std::uint32_t, Surface::PartRead>> parts;
  for (const Range& range : random_ranges(surface.mesh().vertex_count(), random))
    parts.emplace_back(range.begin, read_part(range.begin, range.end));
  std::sort(parts.begin(), parts.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  Surface::PartRead all;
  for (const auto& [begin, part] : parts) all.add(part);
  return surface.take(all);
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
      check_same(read_in_parts(parts, random,
                               [&](std::uint32_t begin, std::uint32_t end) {
                                 return parts.read_positions(moved.positions, begin, end);
                               }),
                 whole.set_positions(moved.positions));
      for (const RefitOf what : {RefitOf::vertices, RefitOf::faces}) refit_in_parts(parts, what, random);
      whole.refit_vertices();
      whole.refit_faces();
      check_same(parts, whole);
      vertices += moved.positions.size();
    }
    const std::array<double, 12> pose{0, -1, 0, 0.5, 1, 0, 0, 0.25, 0, 0, 1, -4};
    check_same(read_in_parts(
                   parts, random,
                   [&](std::uint32_t begin, std::uint32_t end) { return parts.read_pose(pose, begin, end); }),
               whole.set_pose(pose));
    check_same(parts, whole);
  }
  std::cout << "compared " << vertices << " vertices\n";
}

TEST_CASE("a surface in parts: the first bad vertex is named and nothing is taken") {
  const oracle::Shape shape = shape_of(models::sphere(20, 20));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    oracle::Random random(seed);
    Surface parts(mesh_of(shape));
    Surface whole(mesh_of(shape));
    oracle::Shape moved = mapped(shape, 2, Eigen::Vector3d::Zero());
    for (int bad = 0; bad < 3; ++bad)
      moved.positions[random.below(static_cast<std::uint32_t>(moved.positions.size()))].y() =
          bad == 1 ? 0x1p121 : std::numeric_limits<double>::quiet_NaN();
    const Surface::ReadResult result =
        read_in_parts(parts, random, [&](std::uint32_t begin, std::uint32_t end) {
          return parts.read_positions(moved.positions, begin, end);
        });
    CHECK_FALSE(result.taken());
    check_same(result, whole.set_positions(moved.positions));
    check_same(parts, whole);
  }
}

}  // namespace graze::tests
