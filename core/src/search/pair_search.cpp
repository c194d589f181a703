#include "search/pair_search.hpp"

#include <chrono>

#include "core/search/pair_detector.hpp"
#include "pair/time_limit.hpp"
#include "search/deepest_contacts.hpp"
#include "search/past_seams.hpp"
#include "search/solids/solid_search.hpp"
#include "search/solids/way_out_search.hpp"
#include "search/workers/search_worker.hpp"

namespace graze {

void PairSearch::begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                       PairAnswer& answer, bool sliced) {
  pair_ = {&a, &b, query, &front, &answer};
  slices_.begin(sliced);
  phase_ = Phase::start;
  front.walked = true;
  answer.in_contact = answer.listed = answer.cut = false;
  answer.complete = true;
  answer.inside = Inside::none;
  answer.way_out = {};
}

bool PairSearch::advance(SearchScratch& scratch, PairCounters& counters) {
  SearchWorker worker(pair_, scratch, counters);
  try {
    go_on(worker);
  } catch (const TimeIsUp&) {
    give_up();
  }
  return phase_ == Phase::done;
}

/// Goes on as far as a stage of several slices, or the answer.
void PairSearch::go_on(SearchWorker& worker) {
  while (phase_ != Phase::done) {
    next_stage(worker);
    if (phase_ == Phase::done || slice_count() > 1) return;
    if (slice_count() == 0) continue;
    // Every stage makes this room, so that later queries for contacts have it, too.
    contacts_.make_room_until_deadline(worker);
    run(0, worker);
  }
}

void PairSearch::next_stage(SearchWorker& worker) {
  SearchProgress progress = slices_.are_complete() ? end_stage(worker) : SearchProgress::gave_up;
  if (progress == SearchProgress::no_contact) {
    phase_ = Phase::closest;
    progress = closest_.begin(worker);
  }
  if (progress == SearchProgress::answered && pair_.query.has_solid()) progress = complete_solids(worker);
  if (progress == SearchProgress::answered && pair_.query.wants_way_out)
    progress = WayOutSearch(pair_, worker).complete();
  if (progress == SearchProgress::gave_up) return give_up();
  if (progress != SearchProgress::answered) return;
  phase_ = Phase::done;
  if (pair_.query.detail != ContactDetail::nearest) return;
  leave_out_past_seams(worker.pair, pair_.query, *pair_.answer);
  if (pair_.deepest_kept() > 0) keep_deepest(*pair_.answer, pair_.deepest_kept());
}

/// Completes an answer about a pair with a solid. Where it asks for the closest points, these may be known at
/// once. Then it completes the new answer, which lists the pair, so that it does not ask again.
SearchProgress PairSearch::complete_solids(SearchWorker& worker) {
  const TouchingEdges* touching = contacts_.touching();
  if (touching == nullptr && phase_ == Phase::closest) touching = closest_.touching();
  const SearchProgress progress = SolidSearch(pair_, worker, touching).complete();
  if (progress != SearchProgress::no_contact) return progress;
  phase_ = Phase::closest;
  const SearchProgress again = closest_.begin(worker);
  return again == SearchProgress::answered ? complete_solids(worker) : again;
}

/// Puts the results of the stage together, and begins the next.
SearchProgress PairSearch::end_stage(SearchWorker& worker) {
  switch (phase_) {
    case Phase::start:
      return begin_search(worker);
    case Phase::contacts:
      return contacts_.next_stage(worker);
    case Phase::closest:
      return closest_.next_stage(worker);
    case Phase::done:
      break;
  }
  return SearchProgress::answered;
}

SearchProgress PairSearch::begin_search(SearchWorker& worker) {
  phase_ = Phase::contacts;
  if (pair_.query.mode == AccuracyMode::paper) return contacts_.find_as_in_paper(worker);
  const ContactDetail detail = pair_.query.detail;
  const bool wants_contacts = detail != ContactDetail::none && detail != ContactDetail::closest;
  return wants_contacts ? contacts_.begin(worker) : SearchProgress::no_contact;
}

std::size_t PairSearch::slice_count() const {
  return phase_ == Phase::contacts ? contacts_.slice_count() : slices_.size();
}

void PairSearch::run_slice(std::size_t index, SearchScratch& scratch, PairCounters& counters) {
  SearchWorker worker(pair_, scratch, counters);
  bool& complete = phase_ == Phase::contacts ? contacts_.is_complete(index) : slices_[index].complete;
  // A slice that comes too late is not begun, so that it does not throw either.
  complete = !worker.time.is_set() || worker.time.left() > std::chrono::nanoseconds(0);
  if (!complete) return;
  try {
    run(index, worker);
  } catch (const TimeIsUp&) {
    complete = false;
  }
}

void PairSearch::run(std::size_t index, SearchWorker& worker) {
  if (phase_ == Phase::contacts)
    contacts_.run(index, worker);
  else
    closest_.run(slices_[index], worker);
}

void PairSearch::give_up() {
  slices_.clear();
  phase_ = Phase::done;
  PairDetector::outer_bounds(*pair_.a, *pair_.b, pair_.query, *pair_.answer);
}

void PairSearch::reserve_as(const PairSearch& other) {
  if (other.slices_.are_unused()) return;
  slices_.reserve_as(other.slices_);
  contacts_.reserve_as(other.contacts_);
  closest_.reserve_as(other.closest_);
  graze::reserve_as(near_blocks_, other.near_blocks_);
}

void PairSearch::reserve(const PairRoom& room) {
  slices_.reserve(room);
  contacts_.reserve(room);
  closest_.reserve(room);
  graze::reserve(near_blocks_, room);
}

std::size_t PairSearch::byte_count() const {
  return slices_.byte_count() + contacts_.byte_count() + closest_.byte_count() + bytes_of(near_blocks_);
}

}  // namespace graze
