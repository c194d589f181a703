#include "search/solids/solid_search.hpp"

#include <limits>
#include <memory>

#include "leaves/touching_features.hpp"

namespace graze {

bool SolidSearch::widen_reach() {
  if (!find_inside(pair_.query.threshold)) return false;
  if (has_some()) pair_.query.reach = std::numeric_limits<double>::infinity();
  return true;
}

SearchProgress SolidSearch::complete() {
  PairAnswer& answer = *pair_.answer;
  const double apart = answer.listed ? answer.distance.lower : pair_.query.reach;
  if (!find_inside(apart)) return SearchProgress::gave_up;
  if (has_some() && !answer.listed) {
    pair_.query.reach = std::numeric_limits<double>::infinity();
    return SearchProgress::no_contact;
  }
  if (has_some()) answer.in_contact = true;
  if (answer.listed && pair_.query.detail == ContactDetail::nearest) {
    add_contacts_inside();
    set_sides();
    turn_pushes();
  }
  return SearchProgress::answered;
}

bool SolidSearch::has_some() const {
  return scratch_.a_in_b.has_some() || scratch_.b_in_a.has_some();
}

/// Finds what is inside, of surfaces that are at least so far apart where their faces are not ignored.
/// Ignored faces bound a solid too. Returns false if the budget is spent.
bool SolidSearch::find_inside(double apart) {
  scratch_.a_in_b.set_none(*pair_.a);
  scratch_.b_in_a.set_none(*pair_.b);
  pair_.answer->inside = Inside::none;
  if (common(pair_.a->box(), pair_.b->box()).empty()) return true;
  if (knows_inside()) {
    repeat_inside();
    return true;
  }
  if (pair_.query.groups != nullptr) apart = 0;
  if (touching_ == nullptr && !find_touching(apart)) return false;
  if (pair_.query.b_is_solid) scratch_.a_in_b.find(*pair_.a, *pair_.b, touching_->of_a, worker_.pair.count);
  if (pair_.query.a_is_solid) scratch_.b_in_a.find(*pair_.b, *pair_.a, touching_->of_b, worker_.pair.count);
  pair_.answer->inside = state(touching_->pierced);
  remember_inside(apart);
  return true;
}

/// Whether what was found for earlier positions still holds.
bool SolidSearch::knows_inside() const {
  const LastInside* const last = pair_.front->last_inside.get();
  if (last == nullptr || !(last->apart > 0)) return false;
  const double motion = pair_.a->motion_since(last->travel_a) + pair_.b->motion_since(last->travel_b);
  return motion * round_up < last->apart;
}

void SolidSearch::repeat_inside() {
  pair_.answer->inside = pair_.front->last_inside->inside;
  if (pair_.answer->inside == Inside::a_in_b) scratch_.a_in_b.set_all(*pair_.a);
  if (pair_.answer->inside == Inside::b_in_a) scratch_.b_in_a.set_all(*pair_.b);
}

/// Looks for the edges that touch, if the surfaces may. Returns false if the budget is spent.
bool SolidSearch::find_touching(double apart) {
  scratch_.touching.clear();
  touching_ = &scratch_.touching;
  if (apart > 0) return true;
  const SurfacePair whole{*pair_.a, *pair_.b, worker_.pair.count, worker_.pair.time};
  LeafPairs leaf_pairs(whole, pair_.query, worker_.scratch.leaf_pairs, worker_.meter);
  LeafPairList& found = scratch_.touching_leaves;
  found.clear();
  const auto touches = [](double lower, double /*slack*/) { return lower == 0; };
  if (!leaf_pairs.walk_all(
          touches, [](const RegionPair&) {}, found))
    return false;
  worker_.begin_leaves(found);
  TouchingFeatures features(whole, worker_.pair.groups, worker_.scratch.features, scratch_.touching);
  for (const LeafPair& leaves : found.leaves)
    features.add(leaf_pairs.leaf_a(leaves.pair), leaf_pairs.leaf_b(leaves.pair));
  features.finish();
  return true;
}

Inside SolidSearch::state(bool pierced) const {
  const bool all_of_a = scratch_.a_in_b.has_all(*pair_.a);
  const bool all_of_b = scratch_.b_in_a.has_all(*pair_.b);
  if (pierced || (scratch_.a_in_b.has_some() && !all_of_a) || (scratch_.b_in_a.has_some() && !all_of_b))
    return Inside::crossing;
  if (all_of_a) return Inside::a_in_b;
  return all_of_b ? Inside::b_in_a : Inside::none;
}

/// Remembers the state of surfaces that are so far apart. It has to say which vertices are inside.
void SolidSearch::remember_inside(double apart) const {
  auto& kept = pair_.front->last_inside;
  if (kept == nullptr) kept = std::make_unique<LastInside>();
  LastInside& last = *kept;
  last = {};
  const bool is_known =
      pair_.answer->inside != Inside::crossing && !(scratch_.a_in_b.has_some() && scratch_.b_in_a.has_some());
  if (is_known) last = {pair_.answer->inside, apart, pair_.a->travel(), pair_.b->travel()};
}

}  // namespace graze
