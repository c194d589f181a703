// Benchmarks of the work for each vertex of an object that moved, and of tests of boxes. The rates are in
// vertices and in boxes.

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/surface/surface.hpp"
#include "models/models.hpp"
#include "scenes/random.hpp"

namespace {

using namespace graze;  // NOLINT: the vocabulary of this file

std::shared_ptr<const Mesh> ball(std::int64_t segments) {
  const auto count = static_cast<std::uint32_t>(segments);
  const models::MeshData data = models::sphere(count, count);
  return std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
}

/// Two shapes in turn, so that every frame moves every vertex.
std::array<std::vector<Eigen::Vector3f>, 2> frames_of(const Mesh& mesh) {
  std::array<std::vector<Eigen::Vector3f>, 2> frames;
  for (const Eigen::Vector3d& rest : mesh.rest()) {
    frames[0].push_back(rest.cast<float>());
    frames[1].push_back((1.01 * rest).cast<float>());
  }
  return frames;
}

void count_vertices(benchmark::State& state, const Mesh& mesh) {
  state.SetItemsProcessed(state.iterations() * std::int64_t{mesh.vertex_count()});
}

void read_positions(benchmark::State& state) {
  const auto mesh = ball(state.range(0));
  const auto frames = frames_of(*mesh);
  Surface surface(mesh);
  std::size_t frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(surface.set_positions(frames[++frame % 2]));
  count_vertices(state, *mesh);
}

template <RefitOf what>
void refit(benchmark::State& state) {
  const auto mesh = ball(state.range(0));
  const auto frames = frames_of(*mesh);
  Surface surface(mesh);
  std::size_t frame = 0;
  for (auto _ : state) {
    state.PauseTiming();
    surface.set_positions(frames[++frame % 2]);
    state.ResumeTiming();
    surface.refit(what);
  }
  count_vertices(state, *mesh);
}

void box_distances(benchmark::State& state) {
  constexpr std::size_t count = 64;
  scenes::Random random(1);
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (int corner = 0; corner < 2; ++corner) box.add(random.vector(-1, 1));
  for (auto _ : state)
    for (const Box& a : boxes)
      for (const Box& b : boxes) benchmark::DoNotOptimize(lower_distance(a, b));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count * count));
}

BENCHMARK(read_positions)->Arg(16)->Arg(32)->Arg(316);
BENCHMARK(refit<RefitOf::vertices>)->Arg(16)->Arg(32)->Arg(316);
BENCHMARK(refit<RefitOf::faces>)->Arg(16)->Arg(32)->Arg(316);
BENCHMARK(box_distances);

}  // namespace
