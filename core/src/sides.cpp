#include "sides.hpp"

#include <span>

namespace graze {

namespace {

constexpr double half_turn = 3.14159265358979323846;

using Corners = std::array<std::uint32_t, 3>;

/// The corners of each of a face's triangles that has the vertex, from it around.
template <typename Use>
void for_each_triangle_from(std::uint32_t vertex, std::span<const std::uint32_t> face, Use use) {
  for (std::size_t last = 2; last < face.size(); ++last) {
    const Corners corner{face[0], face[last - 1], face[last]};
    if (corner[0] == vertex)
      use(corner);
    else if (corner[1] == vertex)
      use(Corners{corner[1], corner[2], corner[0]});
    else if (corner[2] == vertex)
      use(Corners{corner[2], corner[0], corner[1]});
  }
}

}  // namespace

void NormalSums::add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal) {
  normal = {};
  const std::uint32_t index = piece.feature.index;
  switch (piece.feature.kind) {
    case FeatureKind::vertex:
      return add_vertex(surface, index, normal);
    case FeatureKind::edge:
      return add_edge(surface, index, normal);
    case FeatureKind::face:
      if (piece.piece != Piece::fold) add_triangle(surface, corners_of(surface.mesh(), piece), 1, normal);
  }
}

void NormalSums::add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal) {
  for (const std::uint32_t face : surface.mesh().vertex_faces(vertex))
    for_each_triangle_from(vertex, surface.mesh().face(face),
                           [&](const Corners& corner) { add_triangle(surface, corner, 0, normal); });
}

void NormalSums::add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal) {
  const std::array<std::uint32_t, 2> end = surface.mesh().edge(edge);
  for (const std::uint32_t face : surface.mesh().edge_faces(edge))
    for_each_triangle_from(end[0], surface.mesh().face(face), [&](const Corners& corner) {
      if (corner[1] == end[1] || corner[2] == end[1]) add_triangle(surface, corner, half_turn, normal);
    });
}

void NormalSums::add_triangle(const Surface& surface, const Corners& corner, double weight,
                              RoughNormal& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d point = surface.position(corner[i]);
    for (int axis = 0; axis < 3; ++axis) batch_.corner[i][axis][count_] = point[axis];
  }
  batch_.weight[count_] = weight;
  normal_[count_] = &normal;
  if (++count_ == normal_.size()) finish();
}

void NormalSums::finish() {
  if (count_ == 0) return;
  kernels::measure().normals(batch_);
  for (std::size_t i = 0; i < count_; ++i) {
    normal_[i]->sum += Eigen::Vector3d(batch_.part[0][i], batch_.part[1][i], batch_.part[2][i]);
    normal_[i]->weights += batch_.weight[i];
  }
  count_ = 0;
}

void NormalCache::begin() {
  entries_.resize(size);
  first_round_ = ++round_;
}

NormalCache::Found NormalCache::find(const FeaturePiece& piece) {
  const std::size_t place =
      std::size_t{piece.feature.index} * 3 + static_cast<std::size_t>(piece.feature.kind);
  Entry& entry = entries_[place % size];
  const bool is_known = entry.round >= first_round_ && entry.piece == piece;
  if (!is_known) {
    if (entry.round == round_) return {nullptr, false};
    entry.piece = piece;
  }
  entry.round = round_;
  return {&entry.normal, !is_known};
}

void Sides::begin() {
  count_ = 0;
  sums_.begin();
  normals_a_.begin();
  normals_b_.begin();
}

void Sides::add(const SurfacePair& pair, const ContactName& name, Contact& contact) {
  if (contact.distance == 0) return;
  if (count_ < asked_.size() && take(pair, name, contact)) return;
  finish(pair);
  take(pair, name, contact);
}

/// False where a normal is to be kept in the place of another one.
bool Sides::take(const SurfacePair& pair, const ContactName& name, Contact& contact) {
  const auto [normal_a, is_new_a] = normals_a_.find(name.a);
  if (normal_a == nullptr) return false;
  if (is_new_a) sums_.add(pair.a, name.a, *normal_a);
  const auto [normal_b, is_new_b] = normals_b_.find(name.b);
  if (normal_b == nullptr) return false;
  if (is_new_b) sums_.add(pair.b, name.b, *normal_b);
  asked_[count_++] = {name.a, name.b, &contact, normal_a, normal_b};
  return true;
}

void Sides::finish(const SurfacePair& pair) {
  sums_.finish();
  for (const Asked& asked : std::span(asked_).first(count_)) {
    const Eigen::Vector3d& direction = asked.contact->normal;
    const auto side_a = certain_side(*asked.normal_a, direction);
    const auto side_b = certain_side(*asked.normal_b, -direction);
    asked.contact->side_a = side_a ? *side_a : side_of(pair.a, asked.a, direction, pair.count);
    asked.contact->side_b = side_b ? *side_b : side_of(pair.b, asked.b, -direction, pair.count);
  }
  count_ = 0;
  normals_a_.begin_round();
  normals_b_.begin_round();
}

}  // namespace graze
