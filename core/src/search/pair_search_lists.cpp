// The part of a pair's search that goes by lists of near features, and makes them.

#include <algorithm>
#include <memory>
#include <span>

#include "core/base/growth_policy.hpp"
#include "leaves/feature_pairs.hpp"
#include "search/pair_search.hpp"
#include "search/pair_search_worker.hpp"

namespace graze {
namespace {

constexpr std::size_t listed_each = 1024;
/// How many listed pairs cost one unit of the budget. Testing two leaves costs one as well.
constexpr std::size_t listed_in_one = 64;
/// How many pairs are put into a pair's list between two checks of the clock.
constexpr std::size_t kept_at_once = 1024;

}  // namespace

/// Uses the list of an earlier query where it still has all that can be in contact. Otherwise, where the
/// surfaces move little, a new list is made on the way.
void PairSearch::begin_listing() {
  wanted_ = query_.threshold;
  is_listing_ = false;
  if (query_.detail == ContactDetail::regions) return;
  if (const NearList* const near = front_->list_for(*a_, *b_, query_.threshold)) {
    stage_ = Stage::listed;
    front_->walked = false;
    slice_count_ = 0;
    return add_slices_of(0, near->pairs.size(), listed_each);
  }
  if (!(query_.list_slack > 0)) return front_->forget_list();
  is_listing_ = !front_->list_is_too_long && query_.front_limit >= least_limit;
  if (is_listing_) wanted_ += query_.list_slack;
}

NearListing PairSearch::listing_in(Slice& slice) const {
  return is_listing_ ? NearListing{&slice.near, query_.list_slack} : NearListing{};
}

void PairSearch::run_listed(Slice& slice, Worker& worker) {
  const auto listed = std::span(front_->near->pairs).subspan(slice.begin, slice.end - slice.begin);
  for (std::size_t i = 0; i < listed.size() && slice.complete; i += listed_in_one)
    slice.complete = worker.meter.spend();
  if (!slice.complete) return;
  if (query_.detail == ContactDetail::vertices) {
    for (const FeaturePair& parts : listed) {
      const FeaturePairKey key = FeaturePairKey::of(vertex_piece(parts.a.index), vertex_piece(parts.b.index));
      worker.pair.check_time();
      if (is_closer_than(worker.pair, key, query_.threshold)) slice.keys.push_back(key);
    }
    return;
  }
  worker.begin_listed();
  CloseFeatures features(worker.pair, query_.threshold, worker.scratch.features, slice.keys);
  const std::size_t each = is_limited() ? listed_each : std::max<std::size_t>(1, listed.size());
  for (std::size_t begin = 0; begin < listed.size(); begin += each) {
    features.add_listed(listed.subspan(begin, std::min(each, listed.size() - begin)));
    hand_over_if_many(slice, worker);
    features.set_threshold(threshold_now(worker));
  }
  features.finish();
}

/// Puts what the slices have listed together.
void PairSearch::keep_list(Worker& worker) {
  front_->forget_list();
  std::size_t count = 0;
  for (std::size_t i = 0; i < slice_count_; ++i) {
    count += slices_[i].near.size();
    front_->list_is_too_long = front_->list_is_too_long || slices_[i].near_is_too_long;
  }
  front_->list_is_too_long = front_->list_is_too_long || count > query_.front_limit;
  if (front_->list_is_too_long) {
    ++worker.meter.counters().fronts_left_out;
    return;
  }
  if (front_->near == nullptr) front_->near = std::make_unique<NearList>();
  NearList& near = *front_->near;
  reserve_for_one_of_many(near.pairs, count, query_.front_limit);
  for (const Slice& slice : std::span(slices_).first(slice_count_))
    for (std::size_t begin = 0; begin < slice.near.size(); begin += kept_at_once) {
      worker.time.check_for({});
      const auto some = std::span(slice.near).subspan(begin);
      near.pairs.insert(near.pairs.end(), some.begin(),
                        some.begin() + static_cast<std::ptrdiff_t>(std::min(some.size(), kept_at_once)));
    }
  near.unlisted_lower_bound = wanted_ * round_down;
  near.slack = query_.list_slack;
  near.travel_a = a_->travel();
  near.travel_b = b_->travel();
}

}  // namespace graze
