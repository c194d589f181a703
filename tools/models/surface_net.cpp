#include "models/surface_net.hpp"

#include <cmath>
#include <unordered_map>

namespace graze::models {

namespace {

using Index = Eigen::Vector3i;

class SurfaceNet {
 public:
  SurfaceNet(const Field& field, const Eigen::Vector3d& extent, double cell)
      : field_(field), extent_(extent), cell_(cell) {
    for (int axis = 0; axis < 3; ++axis)
      nodes_[axis] = static_cast<int>(std::ceil(2 * extent[axis] / cell)) + 1;
    values_.reserve(static_cast<std::size_t>(nodes_.prod()));
    for_each_node([this](const Index& node) { values_.push_back(field_(place(node))); });
  }

  TriangleMesh build() {
    for_each_node([this](const Index& node) {
      for (int axis = 0; axis < 3; ++axis) add_across(node, axis);
    });
    return std::move(mesh_);
  }

 private:
  template <typename Visit>
  void for_each_node(const Visit& visit) const {
    for (int z = 0; z < nodes_.z(); ++z)
      for (int y = 0; y < nodes_.y(); ++y)
        for (int x = 0; x < nodes_.x(); ++x) visit(Index(x, y, z));
  }

  [[nodiscard]] std::size_t number(const Index& node) const {
    const Eigen::Matrix<std::size_t, 3, 1> n = node.cast<std::size_t>();
    const Eigen::Matrix<std::size_t, 3, 1> count = nodes_.cast<std::size_t>();
    return (n.z() * count.y() + n.y()) * count.x() + n.x();
  }
  [[nodiscard]] double value(const Index& node) const { return values_[number(node)]; }
  [[nodiscard]] Eigen::Vector3d place(const Index& node) const {
    return cell_ * node.cast<double>() - extent_;
  }

  /// The quad across the grid edge from `node` along `axis`, where the surface cuts it.
  void add_across(const Index& node, int axis) {
    const Index end = node + Index::Unit(axis);
    if (end[axis] >= nodes_[axis] || (value(node) < 0) == (value(end) < 0)) return;
    const Index u = Index::Unit((axis + 1) % 3);
    const Index v = Index::Unit((axis + 2) % 3);
    std::array<std::uint32_t, 4> quad = {vertex_in(node - u - v), vertex_in(node - v), vertex_in(node),
                                         vertex_in(node - u)};
    if (value(node) >= 0) std::swap(quad[1], quad[3]);
    const auto length = [&](std::size_t i, std::size_t j) {
      return (mesh_.positions[quad[i]] - mesh_.positions[quad[j]]).squaredNorm();
    };
    if (length(0, 2) <= length(1, 3)) {
      mesh_.triangles.push_back({quad[0], quad[1], quad[2]});
      mesh_.triangles.push_back({quad[0], quad[2], quad[3]});
    } else {
      mesh_.triangles.push_back({quad[0], quad[1], quad[3]});
      mesh_.triangles.push_back({quad[1], quad[2], quad[3]});
    }
  }

  std::uint32_t vertex_in(const Index& cell) {
    const auto [entry, is_new] =
        vertices_.try_emplace(number(cell), static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(middle_of_cuts(cell));
    return entry->second;
  }

  [[nodiscard]] Eigen::Vector3d middle_of_cuts(const Index& cell) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int cuts = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Index from = cell + Index(corner & 1, corner >> 1 & 1, corner >> 2);
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) continue;
        const Index to = from + Index::Unit(axis);
        if ((value(from) < 0) == (value(to) < 0)) continue;
        const double t = value(from) / (value(from) - value(to));
        sum += place(from) + t * (place(to) - place(from));
        ++cuts;
      }
    }
    return sum / cuts;
  }

  const Field& field_;
  Eigen::Vector3d extent_;
  double cell_;
  Index nodes_;
  std::vector<double> values_;
  std::unordered_map<std::size_t, std::uint32_t> vertices_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh surface_net(const Field& field, const Eigen::Vector3d& extent, double cell) {
  return SurfaceNet(field, extent, cell).build();
}

}  // namespace graze::models
