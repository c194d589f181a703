#include "core/cast/closest_point.hpp"

#include <array>

#include "base/working_memory.hpp"
#include "core/pair/group_filter.hpp"
#include "measure/measure.hpp"
#include "solid/nearest_on_surface.hpp"

namespace graze {
namespace {

/// A surface that is one point: a face whose corners are one vertex.
std::shared_ptr<const Mesh> mesh_of_point() {
  const std::array<Eigen::Vector3d, 1> rest{Eigen::Vector3d::Zero()};
  constexpr std::array<std::array<std::uint32_t, 3>, 1> face{{{0, 0, 0}}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(PositionView(rest), std::span(face)));
}

}  // namespace

struct ClosestPointSearch::Scratch {
  Surface point{mesh_of_point()};
  LeafScratch leaves;
};

ClosestPointSearch::ClosestPointSearch() : scratch_(std::make_unique<Scratch>()) {}
ClosestPointSearch::~ClosestPointSearch() = default;
ClosestPointSearch::ClosestPointSearch(ClosestPointSearch&&) noexcept = default;
ClosestPointSearch& ClosestPointSearch::operator=(ClosestPointSearch&&) noexcept = default;

std::optional<Contact> ClosestPointSearch::find(const Eigen::Vector3d& point, const Surface& surface,
                                                const FaceGroups* groups, double limit) {
  Box at_point;
  at_point.add(point);
  if (const double lower = lower_distance(at_point, surface.box()); lower > 0 && !(lower < limit))
    return std::nullopt;
  const std::array<Eigen::Vector3d, 1> position{point};
  (void)scratch_->point.set_positions(PositionView(position));
  scratch_->point.refit_faces();
  DecisionCount count;
  const FeatureFilter filter(nullptr, groups);
  const SurfacePair pair{scratch_->point, surface, count, nullptr, filter.leaves_all() ? nullptr : &filter};
  scratch_->leaves.begin();
  const auto found = NearestOnSurface(pair, true, scratch_->leaves).find(0);
  if (!found || !is_closer_than(pair, found->key, found->squared, limit)) return std::nullopt;
  return measure(pair, found->key);
}

std::size_t ClosestPointSearch::byte_count() const {
  return sizeof(Scratch) + scratch_->point.byte_count() + bytes_of(scratch_->leaves);
}

}  // namespace graze
