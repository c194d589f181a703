#include "measure/sides.hpp"

#include <span>

#include "measure/normals.hpp"

namespace graze {

void NormalCache::begin() {
  entries_.resize(size);
  normals_.resize(size);
  first_ = oldest_ = next_;
}

void Sides::begin() {
  count_ = 0;
  sums_.begin();
  normals_a_.begin();
  normals_b_.begin();
}

void Sides::add(const SurfacePair& pair, const FeaturePairKey& key, Contact& contact) {
  if (contact.distance == 0) return;
  if (count_ == asked_.size()) finish(pair);
  const FeaturePiece a = key.a();
  const FeaturePiece b = key.b();
  const auto [normal_a, is_new_a] = normals_a_.find(a);
  if (is_new_a) sums_.add(pair.a, a, *normal_a);
  const auto [normal_b, is_new_b] = normals_b_.find(b);
  if (is_new_b) sums_.add(pair.b, b, *normal_b);
  asked_[count_++] = {a, b, &contact, normal_a, normal_b};
}

void Sides::begin_normals() {
  normals_a_.begin_round();
  normals_b_.begin_round();
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
  begin_normals();
}

}  // namespace graze
