// Blocks of vertices and their boxes, beside going through all vertices. Then the kernels over them, beside
// plain loops in the same arithmetic.

#include <algorithm>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <limits>
#include <vector>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "kernels/filter.hpp"
#include "kernels/positions.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"
#include "surface/passes_for.hpp"

namespace graze::tests {
namespace {

using oracle::Random;

/// Calls `use` with every instruction set in use.
template <typename Use>
void with_every_instruction_set(const Use& use) {
  const InstructionSet before = instruction_set();
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    INFO(to_string(set));
    use();
  }
  use_instruction_set(before);
}

/// The longest sides of all blocks' boxes, added up.
double sides_of(const Mesh& mesh, const std::vector<std::uint32_t>& order) {
  double sum = 0;
  for (std::size_t first = 0; first < order.size(); first += VertexBlocks::block_size) {
    Box box;
    for (std::size_t i = first; i < std::min<std::size_t>(first + VertexBlocks::block_size, order.size());
         ++i)
      box.add(mesh.rest()[order[i]]);
    sum += (box.max - box.min).maxCoeff();
  }
  return sum;
}

/// The box of what a level's box stands for, by its blocks' vertices.
Box box_below(const Surface& surface, std::size_t level, std::size_t index) {
  std::size_t blocks = 1;
  for (std::size_t i = 0; i < level; ++i) blocks *= VertexBlocks::group_size;
  Box box;
  const std::size_t end = std::min((index + 1) * blocks, surface.blocks().level(0).count);
  for (std::size_t block = index * blocks; block < end; ++block)
    for (const std::uint32_t vertex : surface.blocks().vertices(static_cast<std::uint32_t>(block)))
      box.add(surface.position(vertex));
  return box;
}

template <typename Number>
float about(double coordinate, double origin) {
  return static_cast<float>(static_cast<Number>(coordinate) - static_cast<Number>(origin));
}

/// Every box of every level. Those behind the last are empty. Returns how many there are.
template <typename Number>
std::size_t check_boxes(const Surface& surface) {
  const VertexBlocks& blocks = surface.blocks();
  CHECK((surface.box().min.array() <= blocks.origin().array()).all());
  CHECK((surface.box().max.array() >= blocks.origin().array()).all());
  std::size_t count = 0;
  for (std::size_t level = 0; level < blocks.level_count(); ++level) {
    const VertexBlocks::Level boxes = blocks.level(level);
    CHECK(boxes.stride % VertexBlocks::group_size == 0);
    for (std::size_t i = 0; i < boxes.stride; ++i) {
      if (i >= boxes.count) {
        CHECK(std::isnan(boxes.rows[i]));
        continue;
      }
      const Box expected = box_below(surface, level, i);
      for (int axis = 0; axis < 3; ++axis) {
        const auto row = static_cast<std::size_t>(axis);
        CHECK(boxes.rows[row * boxes.stride + i] == about<Number>(expected.min[axis], blocks.origin()[axis]));
        CHECK(boxes.rows[(row + 3) * boxes.stride + i] ==
              about<Number>(expected.max[axis], blocks.origin()[axis]));
      }
      ++count;
    }
  }
  return count;
}

template <typename Number>
std::size_t check_surface(const oracle::Shape& shape) {
  const auto mesh = mesh_of(shape);
  std::vector<Eigen::Matrix<Number, 3, 1>> positions;
  for (const Eigen::Vector3d& position : shape.positions) positions.push_back(position.cast<Number>());
  std::size_t count = 0;
  with_every_instruction_set([&] {
    Surface surface(mesh);
    surface.set_positions(positions);
    CHECK_FALSE(surface.has_blocks());
    surface.make_blocks();
    CHECK(surface.has_blocks());
    count += check_boxes<Number>(surface);
  });
  return count;
}

}  // namespace

TEST_CASE("vertex blocks: each used vertex is in one block, whose vertices are near each other at rest") {
  std::vector<oracle::Shape> shapes{shape_of(models::sphere(40, 25)),
                                    shape_of(models::torus(40, 25, 0.7, 0.3)),
                                    shape_of(models::sphere(5, 3))};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const std::uint32_t vertices = 3 + random.below(300);
    shapes.push_back(random_soup(seed, vertices, 1 + random.below(200)));
  }
  for (const oracle::Shape& shape : shapes) {
    const auto mesh = mesh_of(shape);
    std::vector<std::uint32_t> used;
    for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex)
      if (mesh->is_used(vertex)) used.push_back(vertex);
    std::vector<std::uint32_t> order(indexed(*mesh).block_order().begin(),
                                     indexed(*mesh).block_order().end());
    std::sort(order.begin(), order.end());
    CHECK(order == used);
  }
  // Numbers in any order: blocks are as those of a well numbered mesh.
  const auto sphere = mesh_of(shapes.front());
  std::vector<std::uint32_t> shuffled(sphere->vertex_count());
  Random random(7);
  for (std::uint32_t i = 0; i < shuffled.size(); ++i) {
    shuffled[i] = i;
    std::swap(shuffled[i], shuffled[random.below(i + 1)]);
  }
  const std::vector<std::uint32_t> order(indexed(*sphere).block_order().begin(),
                                         indexed(*sphere).block_order().end());
  CHECK(sides_of(*sphere, order) < 0.25 * sides_of(*sphere, shuffled));
}

TEST_CASE("vertex blocks: boxes of every level are those of their vertices") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const std::uint32_t vertices = 3 + random.below(200);
    oracle::Shape shape = random_soup(seed, vertices, 1 + random.below(300));
    const double size = std::ldexp(1.0, static_cast<int>(random.below(240)) - 120);
    for (Eigen::Vector3d& position : shape.positions) position *= size;
    compared += check_surface<float>(mapped(shape, 1, {0, 0, 0})) + check_surface<double>(shape);
  }
  compared += check_surface<float>(shape_of(models::sphere(80, 60)));
  compared += check_surface<double>(mapped(shape_of(models::sphere(80, 60)), 1, {1e7, -3e7, 0}));
  CHECK(compared > 5000);
  std::cout << "compared " << compared << " boxes of blocks\n";
}

namespace {

/// Boxes of stretches of so many random points. Returns how many.
template <typename Number>
std::size_t check_stretches(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Eigen::Matrix<Number, 3, 1>> positions;
  for (std::size_t i = 0; i < count; ++i) positions.push_back(random.vector(-1, 1).template cast<Number>());
  VertexStretches stretches;
  stretches.make(positions);
  for (std::size_t i = 0; i < stretches.stride(); ++i) {
    Box box;
    const std::size_t first = i * VertexStretches::stretch_size;
    for (std::size_t k = first; k < std::min(first + VertexStretches::stretch_size, count); ++k)
      box.add(positions[k].template cast<double>());
    for (int axis = 0; axis < 3; ++axis) {
      const float* const row = stretches.rows() + static_cast<std::size_t>(axis) * stretches.stride();
      if (box.empty()) {
        CHECK(std::isnan(row[i]));
        continue;
      }
      CHECK(row[i] == about<Number>(box.min[axis], stretches.origin()[axis]));
      CHECK(row[3 * stretches.stride() + i] == about<Number>(box.max[axis], stretches.origin()[axis]));
    }
  }
  return stretches.stride();
}

}  // namespace

TEST_CASE("vertex stretches: boxes are those of their vertices") {
  std::size_t compared = 0;
  with_every_instruction_set([&] {
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      compared += check_stretches<float>(seed, 1 + seed) + check_stretches<double>(seed, 1 + seed);
  });
  CHECK(compared > 5000);
}

TEST_CASE("vertex stretches: a large mesh lists the groups of blocks that each is in") {
  const auto mesh = mesh_of(shape_of(models::torus(160, 70, 0.7, 0.3)));
  REQUIRE(indexed(*mesh).has_stretches());
  std::vector<std::vector<std::uint32_t>> expected(mesh->vertex_count() / VertexStretches::stretch_size + 1);
  for (std::uint32_t place = 0; place < mesh->vertex_count(); ++place)
    expected[indexed(*mesh).block_order()[place] / VertexStretches::stretch_size].push_back(
        place / (VertexBlocks::block_size * VertexBlocks::group_size));
  for (std::uint32_t stretch = 0; stretch * VertexStretches::stretch_size < mesh->vertex_count(); ++stretch) {
    auto& groups = expected[stretch];
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());  // places ascend
    const auto listed = indexed(*mesh).stretch_groups(stretch);
    CHECK(std::vector<std::uint32_t>(listed.begin(), listed.end()) == groups);
  }
  CHECK_FALSE(indexed(*mesh_of(shape_of(models::sphere(80, 60)))).has_stretches());
}

namespace {

/// A block and some others of random points, of which some are not there, and a reach.
template <typename Number>
class BlockAndOthers {
 public:
  explicit BlockAndOthers(std::uint64_t seed) : random_(seed) {
    count_ = 1 + random_.below(kernels::block_size);
    fill(block_, count_);
    const std::uint32_t blocks = 1 + random_.below(6);
    for (std::uint32_t i = 0; i < blocks; ++i) {
      std::vector<Number> block;
      fill(block, 1 + random_.below(kernels::block_size));
      blocks_.insert(blocks_.end(), block.begin(), block.end());
    }
    const std::uint32_t length = random_.below(8);
    for (std::uint32_t i = 0; i < length; ++i) listed_.push_back(random_.below(blocks));
    reach_squared_ = static_cast<Number>(random_.between(0, 1));
  }

  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  /// One by one, in the arithmetic that the kernel promises.
  [[nodiscard]] Pairs near() const {
    Pairs pairs;
    for (std::uint32_t point = 0; point < count_; ++point)
      for (std::uint32_t place = 0; place < listed_.size() * size; ++place) {
        const Number* const other = &blocks_[listed_[place / size] * 3 * size + place % size];
        Number squared[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Number gap = other[axis * size] - block_[axis * size + point];
          squared[axis] = gap * gap;
        }
        if ((squared[0] + squared[1]) + squared[2] <= reach_squared_) pairs.emplace_back(point, place);
      }
    return pairs;
  }
  [[nodiscard]] Pairs found() const {
    std::vector<std::uint32_t> row(std::size_t{size} * size * listed_.size() + kernels::lanes);
    std::vector<std::uint32_t> column(row.size());
    const std::size_t count =
        passes_for<Number>().near_points(block_.data(), count_, blocks_.data(), listed_.data(),
                                         listed_.size(), reach_squared_, {row.data(), column.data()});
    Pairs pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(row[i], column[i]);
    return pairs;
  }

 private:
  static constexpr std::uint32_t size = kernels::block_size;

  void fill(std::vector<Number>& block, std::size_t count) {
    block.resize(3 * size, std::numeric_limits<Number>::quiet_NaN());
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i)
        block[axis * size + i] = static_cast<Number>(random_.between(-0.5, 0.5));
  }

  Random random_;
  std::size_t count_ = 0;
  std::vector<Number> block_;
  std::vector<Number> blocks_;
  std::vector<std::uint32_t> listed_;
  Number reach_squared_ = 0;
};

template <typename Number>
std::size_t check_near(std::uint64_t seed) {
  const BlockAndOthers<Number> given(seed);
  const auto expected = given.near();
  with_every_instruction_set([&] { CHECK(given.found() == expected); });
  return expected.size();
}

/// Boxes in groups, some of them empty, and which meet another, one by one.
std::size_t check_meeting(std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t groups = 1 + random.below(9);
  const std::size_t stride = std::size_t{groups} * VertexBlocks::group_size;
  std::vector<float> rows(6 * stride);
  const auto coordinate = [&] { return 0.25F * static_cast<float>(random.below(9)); };
  for (std::size_t i = 0; i < stride; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows[axis * stride + i] = random.chance(0.1) ? std::numeric_limits<float>::infinity() : coordinate();
      rows[(axis + 3) * stride + i] = rows[axis * stride + i] + coordinate();
    }
  kernels::BoxInFrame with{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    with.min[axis] = coordinate();
    with.max[axis] = with.min[axis] + coordinate();
  }
  std::vector<std::uint32_t> listed;
  for (std::uint32_t group = 0; group < groups; ++group)
    if (random.chance(0.6)) listed.push_back(group);
  const auto expected = [&](const std::vector<std::uint32_t>& of) {
    std::vector<std::uint32_t> meeting;
    for (const std::uint32_t group : of)
      for (std::uint32_t i = group * 16; i < (group + 1) * 16; ++i) {
        bool meets = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
          meets = meets && rows[axis * stride + i] <= with.max[axis] &&
                  rows[(axis + 3) * stride + i] >= with.min[axis];
        if (meets) meeting.push_back(i);
      }
    return meeting;
  };
  std::vector<std::uint32_t> all(groups);
  for (std::uint32_t group = 0; group < groups; ++group) all[group] = group;
  with_every_instruction_set([&] {
    std::vector<std::uint32_t> found(stride + kernels::lanes);
    found.resize(kernels::filter().meeting({rows.data(), stride, stride}, listed.data(), listed.size(), with,
                                           found.data()));
    CHECK(found == expected(listed));
    found.resize(stride + kernels::lanes);
    found.resize(
        kernels::filter().meeting({rows.data(), stride, stride}, nullptr, groups, with, found.data()));
    CHECK(found == expected(all));
  });
  return expected(all).size();
}

}  // namespace

TEST_CASE("vertex blocks: kernels find what is near, the same with every instruction set") {
  std::size_t near = 0;
  std::size_t meeting = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    near += check_near<float>(seed) + check_near<double>(seed);
    meeting += check_meeting(seed);
  }
  CHECK(near > 5000);
  CHECK(meeting > 1000);
  std::cout << "compared " << near << " near pairs and " << meeting << " boxes that meet\n";
}

}  // namespace graze::tests
