#include "core/pair/group_filter.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

const FaceGroups& or_all_in_one(const FaceGroups* groups) {
  static const FaceGroups all_in_one;
  return groups == nullptr ? all_in_one : *groups;
}

}  // namespace

FeatureFilter::FeatureFilter(const FaceGroups* a, const FaceGroups* b)
    : a_(&or_all_in_one(a)),
      b_(&or_all_in_one(b)),
      partners_(a_->partners().data()),
      some_faces_{a_->first_seen_face(), b_->first_seen_face()},
      leaves_some_(a_->all().any() && b_->all().any()),
      leaves_all_(!a_->hides_some() && !b_->hides_some()) {}

bool FeatureFilter::may_of_self(const FeatureRef& a, const FeatureRef& b) const {
  if (self_.exclusion->are_neighbours(a, b)) return false;
  return !(self_.rest_distance > 0) || !self_.exclusion->are_near_at_rest(a, b, self_.rest_distance);
}

/// Between surfaces a vertex is tested with the faces of the other vertex.
bool FeatureFilter::may_vertices_of_self(std::uint32_t a, std::uint32_t b) const {
  if (!self_.is_of_vertices) return may_vertex(a, {FeatureKind::vertex, b});
  return a < b && may_of_self({FeatureRefKind::vertex, a}, {FeatureRefKind::vertex, b});
}

bool FeatureFilter::may_vertex(std::uint32_t vertex, const Feature& feature) const {
  const IndexedMesh& mesh = self_.exclusion->mesh();
  const auto faces = feature.kind == FeatureKind::face   ? std::span(&feature.index, 1)
                     : feature.kind == FeatureKind::edge ? mesh.edge_faces(feature.index)
                                                         : mesh.vertex_faces(feature.index);
  return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t face) {
    return may({FeatureRefKind::vertex, vertex}, {FeatureRefKind::face, face});
  });
}

std::optional<std::array<std::uint32_t, 2>> FeatureFilter::some_vertices(const IndexedMesh& mesh_a,
                                                                         const IndexedMesh& mesh_b) const {
  if (!is_of_self()) return std::array{mesh_a.face(some_faces_[0])[0], mesh_b.face(some_faces_[1])[0]};
  for (const auto& [vertex, face] : self_.exclusion->far_pairs()) {
    const std::uint32_t corner = mesh_b.face(face)[0];
    const bool may_be_tested = self_.is_of_vertices
                                   ? may_vertices(std::min(vertex, corner), std::max(vertex, corner))
                                   : may({FeatureRefKind::vertex, vertex}, {FeatureRefKind::face, face});
    if (may_be_tested) return std::array{vertex, corner};
  }
  return std::nullopt;
}

GroupFilter::GroupFilter(std::shared_ptr<const FaceGroups> a, std::shared_ptr<const FaceGroups> b)
    : FeatureFilter(a.get(), b.get()),
      kept_a_(std::move(a)),
      kept_b_(std::move(b)),
      looked_at_(GroupSet().size(), ~GroupSet()),
      partners_of_sets_(a_->sets().size()) {
  find_all();
}

void GroupFilter::set_groups_of_a(std::shared_ptr<const FaceGroups> groups) {
  const FaceGroups& now = or_all_in_one(groups.get());
  partners_of_sets_.resize(now.sets().size());
  a_ = &now;
  kept_a_ = std::move(groups);
  find_all();
}

void GroupFilter::set_groups_of_b(std::shared_ptr<const FaceGroups> groups) {
  b_ = &or_all_in_one(groups.get());
  kept_b_ = std::move(groups);
  find_all();
}

void GroupFilter::set_ignored(std::uint8_t group_a, std::uint8_t group_b, bool ignored) {
  looked_at_[group_a].set(group_b, !ignored);
  find_all();
}

void GroupFilter::find_all() {
  find_partners();
  find_some_faces();
}

void GroupFilter::find_partners() {
  for (std::size_t set = 0; set < partners_of_sets_.size(); ++set) {
    partners_of_sets_[set].reset();
    const GroupSet& groups = a_->sets()[set];
    for (std::size_t group = 0; group < groups.size(); ++group)
      if (groups.test(group)) partners_of_sets_[set] |= looked_at_[group];
  }
  partners_ = partners_of_sets_.data();
}

void GroupFilter::find_some_faces() {
  leaves_some_ = false;
  leaves_all_ = !a_->hides_some() && !b_->hides_some();
  for (std::size_t group = 0; group < a_->all().size(); ++group) {
    if (!a_->all().test(group)) continue;
    const GroupSet met = looked_at_[group] & b_->all();
    leaves_all_ = leaves_all_ && met == b_->all();
    if (met.none() || leaves_some_) continue;
    leaves_some_ = true;
    std::size_t of_b = 0;
    while (!met.test(of_b)) ++of_b;
    some_faces_ = {a_->first_face_of(group), b_->first_face_of(of_b)};
  }
}

std::size_t GroupFilter::byte_count() const {
  return sizeof(GroupFilter) + bytes_of(looked_at_) + bytes_of(partners_of_sets_);
}

}  // namespace graze
