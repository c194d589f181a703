// The float kernels: a feature of one leaf against a block of features of another, for each instruction set.
// The rate is of pairs.

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/instruction_set.hpp>
#include <vector>

#include "kernels/filter.hpp"
#include "scenes/random.hpp"

namespace {

using namespace graze;  // NOLINT: the vocabulary of this file

constexpr std::size_t leaf = 30;  // vertices; about as many faces and edges twice over
constexpr std::size_t stride = 64;

/// Features in the unit box, of `corners` points each within `reach` of a place, then their size.
std::vector<float> features(std::uint64_t seed, std::size_t components, std::size_t corners, double reach) {
  scenes::Random random(seed);
  std::vector<float> data(components * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const Eigen::Vector3d place = random.vector(-1, 1);
    for (std::size_t corner = 0; corner < corners; ++corner) {
      const Eigen::Vector3d point = place + random.vector(-reach, reach);
      for (std::size_t axis = 0; axis < 3; ++axis)
        data[(3 * corner + axis) * stride + i] = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
    }
    data[3 * corners * stride + i] = 1.5F;
  }
  return data;
}

struct Room {
  std::array<std::uint32_t, stride> index{};
  std::array<float, stride> bound{};
};

constexpr float limit = 0.05F;
constexpr double reach = 0.1;

void use_set(const benchmark::State& state) {
  const auto sets = available_instruction_sets();
  use_instruction_set(sets[static_cast<std::size_t>(state.range(0))]);
}

/// Each query against the block.
template <typename Query, typename Kernel>
void run(benchmark::State& state, const std::vector<float>& queries, std::size_t query_floats,
         std::size_t count, const Kernel& kernel) {
  std::vector<Query> made(leaf);
  for (std::size_t i = 0; i < leaf; ++i) {
    auto* const floats = reinterpret_cast<float*>(&made[i]);
    for (std::size_t k = 0; k < query_floats; ++k) floats[k] = queries[k * stride + i];
  }
  Room room;
  const kernels::Survivors survivors{room.index.data(), room.bound.data()};
  for (auto _ : state)
    for (const Query& query : made) benchmark::DoNotOptimize(kernel(query, survivors));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(leaf * count));
  state.SetLabel(std::string(to_string(instruction_set())));
}

void near_points(benchmark::State& state) {
  use_set(state);
  const auto points = features(1, kernels::point::count, 1, reach);
  run<kernels::Point>(
      state, features(2, kernels::point::count, 1, reach), 4, leaf,
      [&](const kernels::Point& point, const kernels::Survivors& out) {
        return kernels::filter().near_points(point, {points.data(), stride, leaf}, limit, out);
      });
}

void near_segments(benchmark::State& state) {
  use_set(state);
  auto segments = features(3, kernels::segment::count, 2, reach);
  kernels::filter().prepare_segments(segments.data(), stride, stride);
  run<kernels::Segment>(
      state, features(4, kernels::segment::count, 2, reach), 7, stride,
      [&](const kernels::Segment& segment, const kernels::Survivors& out) {
        return kernels::filter().near_segments(segment, {segments.data(), stride, stride}, limit, out);
      });
}

std::vector<float> prepared_triangles() {
  auto triangles = features(5, kernels::triangle::count, 3, reach);
  kernels::filter().prepare_triangles(triangles.data(), stride, stride);
  return triangles;
}

void near_triangles(benchmark::State& state) {
  use_set(state);
  const auto triangles = prepared_triangles();
  run<kernels::Point>(
      state, features(6, kernels::point::count, 1, reach), 4, stride,
      [&](const kernels::Point& point, const kernels::Survivors& out) {
        return kernels::filter().near_triangles(point, {triangles.data(), stride, stride}, limit, out);
      });
}

void maybe_pierced(benchmark::State& state) {
  use_set(state);
  const auto triangles = prepared_triangles();
  run<kernels::Segment>(
      state, features(7, kernels::segment::count, 2, reach), 7, stride,
      [&](const kernels::Segment& segment, const kernels::Survivors& out) {
        return kernels::filter().maybe_pierced(segment, {triangles.data(), stride, stride}, out);
      });
}

void each_set(benchmark::internal::Benchmark* kernel) {
  for (std::size_t i = 0; i < available_instruction_sets().size(); ++i)
    kernel->Arg(static_cast<std::int64_t>(i));
}

BENCHMARK(near_points)->Apply(each_set);
BENCHMARK(near_segments)->Apply(each_set);
BENCHMARK(near_triangles)->Apply(each_set);
BENCHMARK(maybe_pierced)->Apply(each_set);

}  // namespace
