// The part of the search for contacts that goes by lists of near features, and makes them.

#include <algorithm>
#include <memory>
#include <span>

#include "core/base/growth_policy.hpp"
#include "leaves/feature_pairs.hpp"
#include "search/contact_search.hpp"

namespace graze {
namespace {

constexpr std::size_t listed_each = 1024;
/// How many listed pairs cost one unit of the budget. Testing two leaves costs one as well.
constexpr std::size_t listed_in_one = 64;
/// How many pairs are put into a pair's list between two checks of the clock.
constexpr std::size_t kept_at_once = 1024;

}  // namespace

SearchProgress ContactSearch::begin_listed(const NearList& near) {
  stage_ = Stage::listed;
  pair_.front->walked = false;
  slices_.clear();
  slices_.add_range(0, near.pairs.size(), listed_each);
  return SearchProgress::slices;
}

/// A new list is made on the way where the surfaces move little.
void ContactSearch::choose_list_slack() {
  if (!(pair_.query.list_slack > 0)) return pair_.front->forget_list();
  if (!pair_.front->list_is_too_long && pair_.query.front_limit >= least_limit)
    list_slack_ = pair_.query.list_slack;
}

NearListing ContactSearch::listing_in(SearchSlice& slice) const {
  return is_listing() ? NearListing{&slice.contacts.near, list_slack_} : NearListing{};
}

TouchingEdges* ContactSearch::touching_in(SearchSlice& slice) const {
  return pair_.query.has_solid() ? &slice.contacts.touching : nullptr;
}

void ContactSearch::run_listed(SearchSlice& slice, SearchWorker& worker) {
  const auto listed = std::span(pair_.front->near->pairs).subspan(slice.begin, slice.end - slice.begin);
  for (std::size_t i = 0; i < listed.size() && slice.complete; i += listed_in_one)
    slice.complete = worker.meter.spend();
  if (!slice.complete) return;
  if (pair_.query.detail == ContactDetail::vertices) {
    for (const FeaturePair& parts : listed) {
      const FeaturePairKey key = FeaturePairKey::of(vertex_piece(parts.a.index), vertex_piece(parts.b.index));
      worker.pair.check_time();
      if (is_closer_than(worker.pair, key, pair_.query.threshold)) slice.contacts.keys.push_back(key);
    }
    return;
  }
  worker.begin_listed();
  if (pair_.query.detail == ContactDetail::nearest) {
    NearestFeatures features = nearest_features_in(slice, worker);
    test_listed(slice, worker, features);
    return keep_nearest(slice, worker);
  }
  CloseFeatures features(worker.pair, pair_.query.threshold, worker.scratch.features, slice.contacts.keys,
                         slice.contacts.piercing, {}, touching_in(slice));
  test_listed(slice, worker, features);
}

template <typename Features>
void ContactSearch::test_listed(SearchSlice& slice, SearchWorker& worker, Features& features) {
  const auto listed = std::span(pair_.front->near->pairs).subspan(slice.begin, slice.end - slice.begin);
  const std::size_t each = is_limited() ? listed_each : std::max<std::size_t>(1, listed.size());
  for (std::size_t begin = 0; begin < listed.size(); begin += each) {
    features.add_listed(listed.subspan(begin, std::min(each, listed.size() - begin)));
    hand_over_if_many(slice, worker);
    features.set_threshold(threshold_now(worker));
  }
  features.finish();
}

/// Puts what the slices have listed together.
void ContactSearch::keep_list(SearchWorker& worker) {
  LeafFront& front = *pair_.front;
  front.forget_list();
  std::size_t count = 0;
  for (const SearchSlice& slice : slices_.all()) {
    count += slice.contacts.near.size();
    front.list_is_too_long = front.list_is_too_long || slice.contacts.near_is_too_long;
  }
  front.list_is_too_long = front.list_is_too_long || count > pair_.query.front_limit;
  if (front.list_is_too_long) {
    ++worker.meter.counters().fronts_left_out;
    return;
  }
  if (front.near == nullptr) front.near = std::make_unique<NearList>();
  NearList& near = *front.near;
  reserve_for_one_of_many(near.pairs, count, pair_.query.front_limit);
  for (const SearchSlice& slice : slices_.all())
    for (std::size_t begin = 0; begin < slice.contacts.near.size(); begin += kept_at_once) {
      worker.time.check_for({});
      const auto some = std::span(slice.contacts.near).subspan(begin);
      near.pairs.insert(near.pairs.end(), some.begin(),
                        some.begin() + static_cast<std::ptrdiff_t>(std::min(some.size(), kept_at_once)));
    }
  near.unlisted_lower_bound = wanted() * round_down;
  near.slack = list_slack_;
  near.travel_a = pair_.a->travel();
  near.travel_b = pair_.b->travel();
}

}  // namespace graze
