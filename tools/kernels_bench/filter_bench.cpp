// The float kernels, for each instruction set. The rate is of pairs.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/instruction_set.hpp>
#include <numeric>
#include <vector>

#include "kernels/filter.hpp"
#include "scenes/random.hpp"

namespace {

using namespace graze;  // NOLINT: the vocabulary of this file

constexpr std::size_t leaf = 30;  // vertices; about as many faces and edges twice over
constexpr std::size_t stride = 64;
constexpr float limit = 0.05F;
constexpr double reach = 0.1;

/// Features in the unit box, of `Corners` points each within `reach` of a place, as a block has them.
template <std::size_t Corners>
std::vector<float> features(std::uint64_t seed) {
  constexpr float size = 1.5F;
  scenes::Random random(seed);
  std::vector<float> data(kernels::component_count<Corners> * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const Eigen::Vector3d place = random.vector(-1, 1);
    const auto at = [&](std::size_t component) -> float& { return data[component * stride + i]; };
    at(kernels::size_at<Corners>) = size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at(kernels::box_at<Corners> + axis) = size;
      at(kernels::box_at<Corners> + 3 + axis) = -size;
    }
    for (std::size_t corner = 0; corner < Corners; ++corner) {
      const Eigen::Vector3f point = (place + random.vector(-reach, reach)).cast<float>();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float value = point[static_cast<Eigen::Index>(axis)];
        at(3 * corner + axis) = value;
        float& low = at(kernels::box_at<Corners> + axis);
        float& high = at(kernels::box_at<Corners> + 3 + axis);
        low = std::min(low, value - size * kernels::margin);
        high = std::max(high, value + size * kernels::margin);
      }
    }
  }
  return data;
}

void use_set(const benchmark::State& state) {
  const auto sets = available_instruction_sets();
  use_instruction_set(sets[static_cast<std::size_t>(state.range(0))]);
}

template <typename Run>
void measure(benchmark::State& state, std::size_t pairs, const Run& run) {
  for (auto _ : state) benchmark::DoNotOptimize(run());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
  state.SetLabel(std::string(to_string(instruction_set())));
}

void near_points(benchmark::State& state) {
  use_set(state);
  const auto points = features<1>(1);
  const auto rows = features<1>(2);
  std::array<std::uint32_t, stride> index{};
  std::array<float, stride> bound{};
  measure(state, leaf * leaf, [&] {
    std::size_t found = 0;
    for (std::size_t row = 0; row < leaf; ++row)
      found += kernels::filter().near_points(
          {{rows[row], rows[stride + row], rows[2 * stride + row]}, rows[3 * stride + row]},
          {points.data(), stride, leaf}, limit, {index.data(), bound.data()});
    return found;
  });
}

/// Boxes of segments with each other.
void near_boxes(benchmark::State& state) {
  use_set(state);
  const auto rows = features<2>(3);
  const auto columns = features<2>(4);
  std::array<std::uint32_t, leaf> index{};
  std::iota(index.begin(), index.end(), 0U);
  std::vector<std::uint32_t> row(leaf * stride + kernels::lanes);
  std::vector<std::uint32_t> column(row.size());
  const kernels::Block all{rows.data(), stride, stride};
  const kernels::Block boxes{columns.data() + kernels::box_at<2> * stride, stride, stride};
  measure(state, leaf * stride, [&] {
    return kernels::filter().near_boxes({all, kernels::box_at<2>, index.data(), leaf}, boxes, limit,
                                        {row.data(), column.data()});
  });
}

/// Pairs of features that are near each other, as those are that boxes leave.
template <std::size_t CornersA, std::size_t CornersB>
kernels::FeaturePairs<CornersA, CornersB> pairs(std::uint64_t seed) {
  scenes::Random random(seed);
  kernels::FeaturePairs<CornersA, CornersB> pairs{};
  const auto put = [&](kernels::Point& point) {
    const Eigen::Vector3f place = random.vector(-reach, reach).cast<float>();
    point = {{place.x(), place.y(), place.z()}, static_cast<float>(reach)};
  };
  for (std::size_t lane = 0; lane < kernels::lanes; ++lane) {
    for (kernels::Point& point : pairs.a[lane]) put(point);
    for (kernels::Point& point : pairs.b[lane]) put(point);
  }
  return pairs;
}

void bound_segments(benchmark::State& state) {
  use_set(state);
  auto of = pairs<2, 2>(5);
  measure(state, kernels::lanes, [&] { return kernels::filter().bound_segments(of, {limit, limit}); });
}

void bound_points_and_triangles(benchmark::State& state) {
  use_set(state);
  auto of = pairs<1, 3>(6);
  measure(state, kernels::lanes, [&] {
    return kernels::filter().bound_points_and_triangles(of, {limit, limit});
  });
}

void passing(benchmark::State& state) {
  use_set(state);
  auto of = pairs<2, 3>(7);
  measure(state, kernels::lanes, [&] { return kernels::filter().passing(of); });
}

void each_set(benchmark::internal::Benchmark* kernel) {
  for (std::size_t i = 0; i < available_instruction_sets().size(); ++i)
    kernel->Arg(static_cast<std::int64_t>(i));
}

BENCHMARK(near_points)->Apply(each_set);
BENCHMARK(near_boxes)->Apply(each_set);
BENCHMARK(bound_segments)->Apply(each_set);
BENCHMARK(bound_points_and_triangles)->Apply(each_set);
BENCHMARK(passing)->Apply(each_set);

}  // namespace
