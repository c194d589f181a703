#include "solid/nearest_on_surface.hpp"

#include <algorithm>
#include <limits>

#include "base/inplace_vector.hpp"
#include "closest_features/closest_features.hpp"

namespace graze {
namespace {

/// A lower bound of the squared distance of a point and a box.
double lower_squared(const Eigen::Vector3d& point, const Box& box) {
  const Eigen::Vector3d beside = (box.min - point).cwiseMax(point - box.max).cwiseMax(0.0);
  return beside.squaredNorm() * round_down - 0x1p-1000;
}

/// A region, and a lower bound of its squared distance.
struct Open {
  double lower;
  std::uint32_t region;
};

/// The search for what is nearest to one vertex: depth first, and the nearest child first.
class NearestOnSurface {
 public:
  NearestOnSurface(const SurfacePair& pair, VertexOfPair vertex, const std::optional<VertexNearest>& last)
      : pair_(pair),
        surface_(vertex.is_of_a() ? pair.b : pair.a),
        point_((vertex.is_of_a() ? pair.a : pair.b).position(vertex.index())),
        slack_(surface_.motion_since_face_refit()),
        nearest_{{}, vertex} {
    // With groups, what was nearest to another vertex may be no feature for this one.
    if (pair.groups != nullptr || !last || last->vertex.is_of_a() != vertex.is_of_a()) return;
    const FeaturePiece piece = vertex.is_of_a() ? last->key.b() : last->key.a();
    shrink_limit(squared_range(point_, simplex_of(surface_, piece).point[0]));
  }

  std::optional<VertexNearest> find() {
    open_.push_back({lower_of(0), 0});
    while (!open_.empty()) {
      const Open next = open_.back();
      open_.pop_back();
      if (next.lower > limit_) continue;
      const Region& region = tree().region(next.region);
      if (region.is_leaf())
        for (const std::uint32_t face : tree().faces(region)) offer(face);
      else
        open_children(region);
    }
    return has_any_ ? std::optional(nearest_) : std::nullopt;
  }

 private:
  [[nodiscard]] const RegionTree& tree() const { return surface_.mesh().regions(); }
  [[nodiscard]] double lower_of(std::uint32_t region) const {
    const Box& box = surface_.face_boxes()[region];
    return lower_squared(point_, slack_ == 0 ? box : grown(box, slack_));
  }
  /// Puts the nearest child last, since that is taken first.
  void open_children(const Region& region) {
    const std::size_t begin = open_.size();
    for (std::uint32_t i = 0; i < region.child_count; ++i) {
      const Open child{lower_of(region.first_child + i), region.first_child + i};
      std::size_t at = open_.size();
      open_.push_back(child);
      for (; at > begin && open_[at - 1].lower < child.lower; --at) open_[at] = open_[at - 1];
      open_[at] = child;
    }
  }
  void shrink_limit(const SquaredRange& squared) { limit_ = std::min(limit_, squared.high); }
  [[nodiscard]] Box box_of(std::uint32_t face) const {
    Box box;
    for (const std::uint32_t corner : surface_.mesh().face(face)) {
      const Eigen::Vector3d position = surface_.position(corner);
      box.min = box.min.cwiseMin(position);
      box.max = box.max.cwiseMax(position);
    }
    return box;
  }
  [[nodiscard]] bool may(std::uint32_t face) const {
    const FeatureRef vertex{FeatureRefKind::vertex, nearest_.vertex.index()};
    const FeatureRef other{FeatureRefKind::face, face};
    return nearest_.vertex.is_of_a() ? pair_.may(vertex, other) : pair_.may(other, vertex);
  }
  void offer(std::uint32_t face) {
    if (lower_squared(point_, box_of(face)) > limit_ || !may(face)) return;
    pair_.check_time();
    VertexNearest offered{{}, nearest_.vertex};
    const FeaturePiece vertex = vertex_piece(nearest_.vertex.index());
    const FeaturePiece piece = nearest_piece_of_face(point_, surface_, face, pair_.count, offered.squared);
    offered.key =
        nearest_.vertex.is_of_a() ? FeaturePairKey::of(vertex, piece) : FeaturePairKey::of(piece, vertex);
    if (has_any_)
      keep_nearer(pair_, nearest_, offered);
    else
      nearest_ = offered;
    has_any_ = true;
    shrink_limit(nearest_.squared);
  }

  const SurfacePair& pair_;
  const Surface& surface_;
  const Eigen::Vector3d point_;
  const double slack_;
  VertexNearest nearest_;
  bool has_any_ = false;
  double limit_ = std::numeric_limits<double>::infinity();  ///< of the squared distance
  // At most the siblings of one region are open on each level.
  InplaceVector<Open, std::size_t{8} * (RegionTree::max_level + 1)> open_;
};

}  // namespace

std::optional<VertexNearest> nearest_on_surface(const SurfacePair& pair, VertexOfPair vertex,
                                                const std::optional<VertexNearest>& last) {
  return NearestOnSurface(pair, vertex, last).find();
}

}  // namespace graze
