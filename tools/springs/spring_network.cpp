#include "springs/spring_network.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

namespace graze::springs {
namespace {

using VertexPair = std::array<std::uint32_t, 2>;

VertexPair sorted_pair(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// A face beside an edge: which vertex of it follows on each end of the edge.
struct Side {
  std::uint32_t beyond_low = 0;
  std::uint32_t beyond_high = 0;
};

class Network {
 public:
  explicit Network(const models::MeshData& mesh) {
    auto corner = mesh.corners.begin();
    for (const std::uint32_t count : mesh.corner_counts) {
      add_face({corner, corner + count});
      corner += count;
    }
  }

  [[nodiscard]] std::array<std::set<VertexPair>, 3> pairs() const {
    std::array<std::set<VertexPair>, 3> pairs;
    for (const auto& [edge, sides] : edges_) pairs[0].insert(edge);
    pairs[1] = diagonals_;
    for (const auto& [edge, sides] : edges_)
      for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t j = i + 1; j < sides.size(); ++j) {
          pairs[2].insert(sorted_pair(sides[i].beyond_low, sides[j].beyond_low));
          pairs[2].insert(sorted_pair(sides[i].beyond_high, sides[j].beyond_high));
        }
    return pairs;
  }

 private:
  void add_face(std::span<const std::uint32_t> corners) {
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % count];
      const std::uint32_t before = corners[(i + count - 1) % count];
      const std::uint32_t after = corners[(i + 2) % count];
      edges_[sorted_pair(from, to)].push_back(from < to ? Side{before, after} : Side{after, before});
    }
    if (count == 4) {
      diagonals_.insert(sorted_pair(corners[0], corners[2]));
      diagonals_.insert(sorted_pair(corners[1], corners[3]));
    }
  }

  std::map<VertexPair, std::vector<Side>> edges_;
  std::set<VertexPair> diagonals_;
};

}  // namespace

std::vector<Spring> springs_of(const models::MeshData& mesh, const Stiffness& stiffness) {
  const std::array<std::set<VertexPair>, 3> pairs = Network(mesh).pairs();
  const std::array<double, 3> stiffnesses = {stiffness.structural, stiffness.shear, stiffness.bend};
  std::set<VertexPair> taken;
  std::vector<Spring> springs;
  for (std::size_t kind = 0; kind < pairs.size(); ++kind)
    for (const VertexPair& pair : pairs[kind])
      if (pair[0] != pair[1] && taken.insert(pair).second)
        springs.push_back({pair[0], pair[1], static_cast<SpringKind>(kind),
                           (mesh.positions[pair[0]] - mesh.positions[pair[1]]).norm(), stiffnesses[kind]});
  return springs;
}

}  // namespace graze::springs
