// Listed vertices are brought into a frame as one by one: bit for bit, for every instruction set, from floats
// and from doubles.

#include "leaves/layout/listed_vertices.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <limits>
#include <vector>

#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;

bool same_bits(float left, float right) {
  return std::bit_cast<std::uint32_t>(left) == std::bit_cast<std::uint32_t>(right);
}

/// Converts a position to the vertex in the frame that the kernels have to list for it.
kernels::Point local_vertex(const FilterFrame& frame, const Vector3d& position) {
  const Vector3d local = frame.to_local(position);
  const float size = std::max(kernels::least_size, static_cast<float>(local.cwiseAbs().maxCoeff()));
  if (!(size <= kernels::largest_size)) return {{0, 0, 0}, std::numeric_limits<float>::infinity()};
  return {{static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(local.z())},
          size};
}

/// A surface of scattered vertices, some of them minute and some huge, and a list of some of them with the
/// last and others more than once.
template <typename Number>
struct Scattered {
  explicit Scattered(std::uint64_t seed) : random(seed), surface(mesh_of(random_soup(seed, 60, 40))) {
    const std::uint32_t count = surface.mesh().vertex_count();
    for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
      const int scale = random.chance(0.1) ? static_cast<int>(random.below(200)) - 100 : 0;
      auto& position = positions.emplace_back();
      for (int axis = 0; axis < 3; ++axis)
        position[axis] = static_cast<Number>(std::ldexp(random.between(-1, 1), scale));
    }
    surface.set_positions(positions);
    const std::size_t length = random.below(40);
    for (std::size_t i = 0; i < length; ++i)
      listed.push_back(random.chance(0.2) ? count - 1 : random.below(count));
    std::erase_if(listed, [&](std::uint32_t vertex) { return !surface.mesh().is_used(vertex); });
  }

  Random random;
  Surface surface;
  std::vector<Eigen::Matrix<Number, 3, 1>> positions;
  std::vector<std::uint32_t> listed;
};

template <typename Number>
void check_brought(const Scattered<Number>& scattered, const FilterFrame& frame) {
  const auto& listed = scattered.listed;
  std::vector<kernels::Point> brought(listed.size());
  to_frame(scattered.surface, listed, frame, brought.data());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const kernels::Point expected =
        local_vertex(frame, scattered.positions[listed[i]].template cast<double>());
    CHECK(same_bits(brought[i].size, expected.size));
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(same_bits(brought[i].position[axis], expected.position[axis]));
  }
}

template <typename Number>
std::size_t check_all(std::uint64_t seed) {
  Scattered<Number> scattered(seed);
  const double unit = std::ldexp(1.0, static_cast<int>(seed % 9) - 4);
  const Vector3d corner{scattered.random.between(-1, 1), scattered.random.between(-1, 1), 0};
  const Box of_frame{corner, corner + Vector3d::Constant(unit)};
  const FilterFrame frame(of_frame, of_frame);
  check_brought(scattered, frame);
  return scattered.listed.size();
}

}  // namespace

TEST_CASE("listed vertices: in a frame as one by one") {
  const InstructionSet before = instruction_set();
  std::size_t brought = 0;
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      brought += check_all<float>(seed) + check_all<double>(seed);
  }
  use_instruction_set(before);
  CHECK(brought > 5000 * available_instruction_sets().size());
}

}  // namespace graze::tests
