#include "search/contacts/near_list_recorder.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "core/base/growth_policy.hpp"

namespace graze {
namespace {

/// How many pairs are put into a pair's list between two checks of the clock.
constexpr std::size_t kept_at_once = 1024;

}  // namespace

void NearListRecorder::begin() {
  slack_ = 0;
  if (!(pair_.query.list_slack > 0)) return pair_.front->forget_list();
  if (!pair_.front->list_is_too_long && pair_.query.front_limit >= least_limit)
    slack_ = pair_.query.list_slack;
}

NearListing NearListRecorder::listing_in(SearchSlice& slice) const {
  return is_recording() ? NearListing{&slice.contacts.near, slack_} : NearListing{};
}

void NearListRecorder::drop_if_too_long(SearchSlice& slice) const {
  if (slice.contacts.near.size() <= pair_.query.front_limit) return;
  slice.contacts.near.clear();
  slice.contacts.near_is_too_long = true;
}

void NearListRecorder::finish(const SearchSlices& slices, SearchWorker& worker) const {
  if (!is_recording()) return;
  LeafFront& front = *pair_.front;
  front.forget_list();
  std::size_t count = 0;
  for (const SearchSlice& slice : slices.all()) {
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
  for (const SearchSlice& slice : slices.all())
    for (std::size_t begin = 0; begin < slice.contacts.near.size(); begin += kept_at_once) {
      worker.time.check_for({});
      const auto some = std::span(slice.contacts.near).subspan(begin);
      near.pairs.insert(near.pairs.end(), some.begin(),
                        some.begin() + static_cast<std::ptrdiff_t>(std::min(some.size(), kept_at_once)));
    }
  near.unlisted_lower_bound = (pair_.query.threshold + slack_) * round_down;
  near.slack = slack_;
  near.travel_a = pair_.a->travel();
  near.travel_b = pair_.b->travel();
}

}  // namespace graze
