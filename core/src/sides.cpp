#include "sides.hpp"

#include <span>

#include "normals.hpp"

namespace graze {

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
  const auto [normal_a, is_new_a] = normals_a_.find(name.a());
  if (normal_a == nullptr) return false;
  if (is_new_a) sums_.add(pair.a, name.a(), *normal_a);
  const auto [normal_b, is_new_b] = normals_b_.find(name.b());
  if (normal_b == nullptr) return false;
  if (is_new_b) sums_.add(pair.b, name.b(), *normal_b);
  asked_[count_++] = {name.a(), name.b(), &contact, normal_a, normal_b};
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
