#include <algorithm>

#include "support/oracle/oracle.hpp"

namespace graze::oracle {

namespace {

using Faces = std::vector<std::uint32_t>;

/// The faces that have a vertex, or both vertices of an edge next to each other, or are the face.
Faces faces_of(const Shape& shape, const Feature& feature) {
  if (feature.kind == FeatureKind::face) return {feature.index};
  const auto has = [&](const std::vector<std::uint32_t>& corners) {
    if (feature.kind == FeatureKind::vertex)
      return std::find(corners.begin(), corners.end(), feature.index) != corners.end();
    const auto ends = edges_of(shape)[feature.index];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
      if (ends[0] == low && ends[1] == high) return true;
    }
    return false;
  };
  Faces faces;
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face)
    if (has(shape.faces[face])) faces.push_back(face);
  return faces;
}

std::array<std::vector<Faces>, 3> faces_of_all(const Shape& shape) {
  const std::array<std::size_t, 3> counts{shape.positions.size(), edges_of(shape).size(), shape.faces.size()};
  std::array<std::vector<Faces>, 3> all;
  for (const FeatureKind kind : {FeatureKind::vertex, FeatureKind::edge, FeatureKind::face})
    for (std::uint32_t index = 0; index < counts[static_cast<std::size_t>(kind)]; ++index)
      all[static_cast<std::size_t>(kind)].push_back(faces_of(shape, {kind, index}));
  return all;
}

}  // namespace

FacePairs::FacePairs(const Shape& a, const Shape& b,
                     const std::function<bool(std::uint32_t, std::uint32_t)>& are_looked_at)
    : a_(faces_of_all(a)), b_(faces_of_all(b)) {
  for (std::uint32_t face_a = 0; face_a < a.faces.size(); ++face_a) {
    looked_at_.emplace_back();
    for (std::uint32_t face_b = 0; face_b < b.faces.size(); ++face_b)
      looked_at_.back().push_back(are_looked_at(face_a, face_b));
  }
}

bool FacePairs::may(const Feature& a, const Feature& b) const {
  if (is_of_self()) return self_.may(a, b);
  if (looked_at_.empty()) return true;
  for (const std::uint32_t face_a : a_[static_cast<std::size_t>(a.kind)][a.index])
    for (const std::uint32_t face_b : b_[static_cast<std::size_t>(b.kind)][b.index])
      if (looked_at_[face_a][face_b]) return true;
  return false;
}

bool FacePairs::are_some() const {
  return looked_at_.empty() || std::any_of(looked_at_.begin(), looked_at_.end(), [](const auto& of_a) {
           return std::find(of_a.begin(), of_a.end(), true) != of_a.end();
         });
}

}  // namespace graze::oracle
