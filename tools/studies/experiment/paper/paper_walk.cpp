#include "experiment/paper/paper_walk.hpp"

#include <algorithm>
#include <limits>

namespace graze::tools {
namespace {

constexpr VertexPair no_pair{std::numeric_limits<double>::infinity(), 0, 0};

double squared_distance(const Box& a, const Box& b) {
  const Eigen::Vector3d gap = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0);
  return gap.squaredNorm();
}

}  // namespace

PlacedObject::PlacedObject(const RecordedObject& object, std::size_t frame) : mesh_(object.mesh.get()) {
  const PositionView positions = object.positions(frame);
  for (std::size_t i = 0; i < positions.size(); ++i) points_.push_back(positions[i]);
  level_radii_.resize(tree().level_count());
  for (std::uint32_t index = 0; index < tree().region_count(); ++index) {
    const Region& region = tree().region(index);
    if (region.is_leaf()) leaves_.push_back(index);
    double squared = 0;
    Box box;
    for (const std::uint32_t vertex : tree().vertices(region)) {
      squared = std::max(squared, (points_[vertex] - points_[region.middle]).squaredNorm());
      box.add(points_[vertex]);
    }
    radii_.push_back(std::sqrt(squared));
    boxes_.push_back(box);
    level_radii_[region.level] = std::max(level_radii_[region.level], radii_.back());
  }
}

PaperFound PaperWalk::find(const PaperNumbers& numbers) {
  PaperFound found;
  visit(numbers, 0, 0, 0, found);
  return found;
}

/// Eq. 4.
bool PaperWalk::passes(const PaperNumbers& numbers, const Region& a, const Region& b,
                       std::size_t level) const {
  const auto& epsilon = numbers.epsilon;
  const double limit = epsilon.empty() ? a_.level_radii()[a.level] + b_.level_radii()[b.level]
                                       : epsilon[std::min(level, epsilon.size()) - 1];
  return pair_of(a.middle, b.middle).squared < limit * limit;
}

void PaperWalk::visit(const PaperNumbers& numbers, std::uint32_t a, std::uint32_t b, std::size_t level,
                      PaperFound& found) {
  const Region& region_a = a_.tree().region(a);
  const Region& region_b = b_.tree().region(b);
  const bool at_leaves = region_a.is_leaf() && region_b.is_leaf();
  const bool passed = level == 0 || passes(numbers, region_a, region_b, level);
  const std::size_t slot = std::min(level, PaperFound::most_levels - 1);
  found.passed[slot] += passed ? 1U : 0U;
  if (at_leaves) {
    if (passed || !numbers.test_leaves) found.reached.push_back(number_of(a, b));
    return;
  }
  if (!passed) return;
  ++found.expanded[slot];
  const std::uint32_t first_a = region_a.is_leaf() ? a : region_a.first_child;
  const std::uint32_t first_b = region_b.is_leaf() ? b : region_b.first_child;
  for (std::uint32_t i = 0; i < std::max(1U, region_a.child_count); ++i)
    for (std::uint32_t j = 0; j < std::max(1U, region_b.child_count); ++j)
      visit(numbers, first_a + i, first_b + j, level + 1, found);
}

std::uint32_t PaperWalk::number_of(std::uint32_t a, std::uint32_t b) {
  const auto [entry, is_new] =
      numbers_.try_emplace(std::uint64_t{a} << 32U | b, static_cast<std::uint32_t>(leaves_.size()));
  if (is_new) {
    const VertexPair nearest = nearest_of(a_.tree().region(a), b_.tree().region(b));
    leaves_.push_back({a, b, nearest, walk_from(nearest)});
  }
  return entry->second;
}

VertexPair PaperWalk::nearest_of(const Region& a, const Region& b) const {
  VertexPair nearest = no_pair;
  for (const std::uint32_t vertex_a : a_.tree().vertices(a))
    for (const std::uint32_t vertex_b : b_.tree().vertices(b))
      nearest = std::min(nearest, pair_of(vertex_a, vertex_b));
  return nearest;
}

VertexPair PaperWalk::walk_from(VertexPair at) const {
  for (;;) {
    VertexPair best = at;
    const auto around_a = a_.mesh().vertex_neighbours(at.a);
    const auto around_b = b_.mesh().vertex_neighbours(at.b);
    for (const std::uint32_t a : around_a) best = std::min(best, pair_of(a, at.b));
    for (const std::uint32_t b : around_b) best = std::min(best, pair_of(at.a, b));
    for (const std::uint32_t a : around_a)
      for (const std::uint32_t b : around_b) best = std::min(best, pair_of(a, b));
    if (!(best.squared < at.squared)) return at;
    at = best;
  }
}

std::vector<std::uint32_t> PaperWalk::near_leaves(double threshold) {
  const double limit = threshold * threshold;
  std::vector<std::uint32_t> near;
  if (!(squared_distance(a_.boxes()[0], b_.boxes()[0]) < limit)) return near;
  for_each_pair_of_leaves([&](std::uint32_t a, std::uint32_t b) {
    if (!(squared_distance(a_.boxes()[a], b_.boxes()[b]) < limit)) return;
    const std::uint32_t number = number_of(a, b);
    if (leaves_[number].nearest.squared < limit) near.push_back(number);
  });
  return near;
}

std::vector<VertexPair> PaperWalk::near_vertices(double threshold) {
  std::vector<VertexPair> near;
  for (const std::uint32_t number : near_leaves(threshold))
    for (const std::uint32_t a : a_.tree().vertices(a_.tree().region(leaves_[number].a)))
      for (const std::uint32_t b : b_.tree().vertices(b_.tree().region(leaves_[number].b)))
        if (const VertexPair pair = pair_of(a, b); pair.squared < threshold * threshold) near.push_back(pair);
  std::ranges::sort(near, {}, [](const VertexPair& pair) { return std::array{pair.a, pair.b}; });
  return near;
}

VertexPair PaperWalk::nearest_vertices() const {
  // The leaves whose boxes are nearest give a distance that leaves out nearly all others.
  double least = std::numeric_limits<double>::infinity();
  RegionPair first;
  for_each_pair_of_leaves([&](std::uint32_t a, std::uint32_t b) {
    const double squared = squared_distance(a_.boxes()[a], b_.boxes()[b]);
    if (squared < least) {
      least = squared;
      first = {a, b};
    }
  });
  VertexPair nearest = nearest_of(a_.tree().region(first.a), b_.tree().region(first.b));
  for_each_pair_of_leaves([&](std::uint32_t a, std::uint32_t b) {
    if (squared_distance(a_.boxes()[a], b_.boxes()[b]) <= nearest.squared)
      nearest = std::min(nearest, nearest_of(a_.tree().region(a), b_.tree().region(b)));
  });
  return nearest;
}

}  // namespace graze::tools
