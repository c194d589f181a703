#include "geometry/mesh_probe.hpp"

#include <graze/error.hpp>
#include <limits>
#include <string>
#include <utility>

#include "base/pose.hpp"
#include "core/base/bad_vertex_text.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/base/view_check.hpp"
#include "core/mesh/closed.hpp"
#include "core/pair/group_filter.hpp"

namespace graze {

MeshProbe::State::State(std::shared_ptr<const Mesh> mesh, bool is_solid)
    : surface(std::move(mesh)), solid(is_solid) {
  if (!solid) return;
  if (const auto problem = why_not_closed(surface.mesh()))
    throw Error("probe: a solid has a closed surface; " + *problem);
}

bool MeshProbe::State::is_blocked_by(const Surface& other, bool other_is_solid, const FaceGroups* groups,
                                     double clearance) {
  const FeatureFilter filter(nullptr, groups);
  if (!filter.leaves_some()) return false;
  PairQuery query;
  query.detail = ContactDetail::none;
  query.threshold = query.reach = clearance;
  query.a_is_solid = solid;
  query.b_is_solid = other_is_solid;
  if (!filter.leaves_all()) query.groups = &filter;
  surface.refit_faces();
  detector.detect(surface, other, query, answer, counters);
  return answer.in_contact;
}

MeshProbe::MeshProbe(std::shared_ptr<const Mesh> mesh, bool solid) {
  const FloatingPointScope scope;
  state_ = std::make_unique<State>(std::move(mesh), solid);
}
MeshProbe::~MeshProbe() = default;
MeshProbe::MeshProbe(MeshProbe&& other) noexcept = default;
MeshProbe& MeshProbe::operator=(MeshProbe&& other) noexcept = default;

void MeshProbe::set_pose(const Eigen::Isometry3d& pose) {
  const FloatingPointScope scope;
  const std::array<double, 12> rows = rows_of(pose);
  if (const auto problem = problem_of_pose(rows)) throw Error("probe: " + *problem);
  const Surface::ReadResult read = state_->surface.set_pose(rows);
  if (!read.taken()) throw Error("probe: " + bad_vertex_text(read.bad_vertex, read.bad_position));
}

void MeshProbe::set_positions(PositionView positions) {
  const FloatingPointScope scope;
  if (const auto problem = problem_of_view(positions, state_->surface.mesh().vertex_count()))
    throw Error("probe got " + problem->got);
  const Surface::ReadResult read = state_->surface.set_positions(positions);
  if (!read.taken()) throw Error("probe: " + bad_vertex_text(read.bad_vertex, read.bad_position));
}

}  // namespace graze
