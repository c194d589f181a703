#include "search/contacts/contact_search.hpp"

#include <algorithm>
#include <chrono>

#include "base/working_memory.hpp"
#include "pair/room_in_time.hpp"
#include "search/contacts/key_collectors.hpp"
#include "search/solids/solid_search.hpp"

namespace graze {
namespace {

/// The least time that it takes to find a key.
constexpr std::chrono::nanoseconds to_find_one{5};

}  // namespace

// ---- The parts

SearchProgress ContactSearch::begin(SearchWorker& worker) {
  stage_ = Stage::find;
  touching_.clear();
  sunk_edges_.clear();
  fold_.reset();
  choose_parts();
  const SearchProgress progress = std::visit([&](auto& source) { return source.begin(worker); }, source_);
  const bool are_known = progress == SearchProgress::slices && slices_.size() == 0;
  return are_known ? begin_collecting(worker) : progress;
}

void ContactSearch::choose_parts() {
  switch (pair_.query.detail) {
    case ContactDetail::regions:
      return choose_parts_for<RegionFinder>();
    case ContactDetail::vertices:
      return choose_parts_for<VertexFinder>();
    case ContactDetail::nearest:
      return choose_parts_for<NearestFinder>();
    case ContactDetail::features:
    case ContactDetail::closest:
    case ContactDetail::none:
      return choose_parts_for<FeatureFinder>();
  }
}

template <typename Finder>
void ContactSearch::choose_parts_for() {
  const bool keeps_closest = pair_.closest_kept() > 0;
  choose_source<Finder>(keeps_closest);
  leaves_choice_ = Finder::leaves_choice;
  collect_ = &ContactSearch::collect_all<Finder>;
  ordering_ = &all_ordering_;
  if constexpr (Finder::keeps_closest)
    if (keeps_closest) {
      collect_ = &ContactSearch::collect_closest<Finder>;
      ordering_ = &closest_ordering_;
    }
  ordering_->begin(Finder::finds_piercings);
}

/// Uses the near list of an earlier query where it still has all that can be in contact.
template <typename Finder>
void ContactSearch::choose_source(bool nearest_first) {
  const LeafFront& front = *pair_.front;
  recorder_.keep_old_list();
  if constexpr (TakesListed<Finder>) {
    if (front.list_for(*pair_.a, *pair_.b, pair_.query.threshold) != nullptr) {
      source_ = ListSource(pair_, slices_);
      return;
    }
    recorder_.begin();
  }
  const Wanted wanted{pair_.query.threshold + recorder_.slack(), Finder::finds_piercings};
  if constexpr (TakesBlocks<Finder>)
    source_ = BlockSource(pair_, slices_, near_blocks_, wanted.distance);
  else if (front.unlisted_lower_bound_now(*pair_.a, *pair_.b) > wanted.distance)
    source_ = FrontSource(pair_, slices_, wanted, nearest_first);
  else
    source_ = WalkSource(pair_, slices_, wanted, nearest_first);
}

// ---- The stages

SearchProgress ContactSearch::next_stage(SearchWorker& worker) {
  switch (stage_) {
    case Stage::find:
      return begin_collecting(worker);
    case Stage::collect:
      return end_collecting(worker);
    case Stage::choose:
      return begin_ordering(worker);
    case Stage::order:
      for (const Stretch& stretch : ordered_.stretches)
        if (!stretch.complete) return SearchProgress::gave_up;
      return begin_measuring(worker);
    case Stage::measure:
      break;
  }
  return finish(worker);
}

std::size_t ContactSearch::slice_count() const {
  return stage_ == Stage::order ? ordered_.stretches.size() : slices_.size();
}

bool& ContactSearch::is_complete(std::size_t index) {
  return stage_ == Stage::order ? ordered_.stretches[index].complete : slices_[index].complete;
}

void ContactSearch::run(std::size_t index, SearchWorker& worker) {
  switch (stage_) {
    case Stage::find:
      return std::visit([&](const auto& source) { source.find(slices_[index], worker); }, source_);
    case Stage::collect:
      (this->*collect_)(slices_[index], worker);
      if (!has_choice()) ordering_->take(slices_[index], worker);
      return;
    case Stage::choose:
      choice_.run(slices_[index], worker);
      return ordering_->take(slices_[index], worker);
    case Stage::order:
      return ordering_->order(ordered_.stretches[index], worker);
    case Stage::measure:
      return sunk_edges_.mark(measuring_.run(slices_[index], worker));
  }
}

SearchProgress ContactSearch::begin_collecting(SearchWorker& worker) {
  std::visit([&](auto& source) { source.cut(worker); }, source_);
  stage_ = Stage::collect;
  return SearchProgress::slices;
}

template <typename Finder>
void ContactSearch::collect_all(SearchSlice& slice, SearchWorker& worker) {
  const FinderInput input = input_of(slice, worker);
  Finder finder(input);
  AllKeys<Finder> collector(finder);
  feed(slice, worker, collector);
}

template <typename Finder>
void ContactSearch::collect_closest(SearchSlice& slice, SearchWorker& worker) {
  const FinderInput input = input_of(slice, worker);
  Finder finder(input);
  ClosestKeys<Finder> collector(finder, closest_ordering_, recorder_, slice, worker);
  feed(slice, worker, collector);
}

FinderInput ContactSearch::input_of(SearchSlice& slice, SearchWorker& worker) {
  return {worker,
          pair_.query.threshold,
          slice.contacts,
          slices_.size() <= 1,
          recorder_.listing_in(slice),
          pair_.query.has_solid() ? &slice.contacts.touching : nullptr,
          near_blocks_};
}

/// A finder meets only the sources that `choose_source` may give it.
template <typename Collector>
void ContactSearch::feed(SearchSlice& slice, SearchWorker& worker, Collector& collector) {
  std::visit(
      [&](const auto& source) {
        if constexpr (requires { source.feed(slice, worker, collector); })
          source.feed(slice, worker, collector);
      },
      source_);
}

SearchProgress ContactSearch::end_collecting(SearchWorker& worker) {
  std::visit([&](auto& source) { source.end(worker); }, source_);
  recorder_.finish(slices_, worker);
  for (const SearchSlice& slice : slices_.all()) touching_.add(slice.contacts.touching);
  sunk_edges_.gather(slices_.all(), worker.pair.is_of_self());
  fold_ = nearest_fold(slices_, worker.pair);
  if (has_choice()) {
    choice_.begin();
    stage_ = Stage::choose;
    return SearchProgress::slices;
  }
  if (slices_.size() == 1) sunk_edges_.settle(slices_.first().contacts, worker);
  return begin_ordering(worker);
}

SearchProgress ContactSearch::begin_ordering(SearchWorker& worker) {
  if (!ordering_->begin_ordering(worker)) return begin_measuring(worker);
  stage_ = Stage::order;
  return SearchProgress::slices;
}

SearchProgress ContactSearch::begin_measuring(SearchWorker& worker) {
  slices_.clear();
  if (ordered_.count() == 0) return finish_without_contacts(worker);
  measuring_.begin(worker);
  stage_ = Stage::measure;
  return SearchProgress::slices;
}

/// Asks for the closest points where these may be in reach, or where something is inside a solid.
SearchProgress ContactSearch::finish_without_contacts(SearchWorker& worker) {
  if (pair_.query.has_solid() && !SolidSearch(pair_, worker, touching()).widen_reach())
    return SearchProgress::gave_up;
  if (fold_) return finish_at_fold(worker);
  if (pair_.query.reach > pair_.query.threshold) return SearchProgress::no_contact;
  pair_.answer->contacts.clear();
  return SearchProgress::answered;
}

/// Answers for surfaces in contact at a fold alone: it is the one contact then.
SearchProgress ContactSearch::finish_at_fold(SearchWorker& worker) {
  set_distance(*pair_.answer, worker.pair, fold_->key);
  pair_.answer->in_contact = pair_.answer->listed = true;
  pair_.answer->contacts.assign(1, measure(worker.pair, fold_->key));
  return SearchProgress::answered;
}

SearchProgress ContactSearch::finish(SearchWorker& worker) {
  FeaturePairKey lowest = measuring_.lowest(worker);
  if (fold_) lowest = lower_of(worker, lowest, fold_->key);
  set_distance(*pair_.answer, worker.pair, lowest);
  pair_.answer->in_contact = pair_.answer->listed = true;
  slices_.clear();
  return SearchProgress::answered;
}

// ---- Memory

void ContactSearch::make_room_until_deadline(SearchWorker& worker) {
  if (slices_.may_cut()) return;
  FoundContacts& contacts = slices_.first().contacts;
  reserve_until_deadline(contacts.keys, to_find_one, worker.pair.time);
  if (recorder_.is_recording()) reserve_until_deadline(contacts.near, to_find_one, worker.pair.time);
}

void ContactSearch::reserve_as(const ContactSearch& other) {
  FoundContacts& first = slices_.first().contacts;
  const FoundContacts& other_first = other.slices_.first().contacts;
  graze::reserve_as(first.near, other_first.near);
  graze::reserve_as(first.of_vertices, other_first.of_vertices);
  graze::reserve_as(first.touching, other_first.touching);
  graze::reserve_as(touching_, other.touching_);
  graze::reserve_as(first.piercing, other_first.piercing);
  graze::reserve_as(first.edges_if_sunk, other_first.edges_if_sunk);
  sunk_edges_.reserve_as(other.sunk_edges_);
  reserve_swapped_as(ordered_.keys, first.keys, other.ordered_.keys, other_first.keys);
  ordered_.stretches.reserve(1);
  nearest_keys_.reserve_as(other.nearest_keys_);
}

void ContactSearch::reserve(const PairRoom& room) {
  FoundContacts& first = slices_.first().contacts;
  for (auto* const keys : {&ordered_.keys, &first.keys}) keys->reserve(keys_of_contact * room.contacts);
  first.near.reserve(keys_of_contact * room.contacts);
  first.piercing.reserve(room.contacts);
  first.edges_if_sunk.reserve(room.contacts);
  sunk_edges_.reserve(room.contacts);
  ordered_.stretches.reserve(1);
}

/// The slice of a pair that is not cut is there, since `reserve` was called before.
void ContactSearch::reserve_for_solids() {
  slices_.first().contacts.touching.reserve();
  touching_.reserve();
}

void ContactSearch::reserve_for_limit(std::size_t most, const PairRoom& room) {
  nearest_keys_.reserve(most, keys_of_contact * room.contacts);
}

std::size_t ContactSearch::byte_count() const {
  return bytes_of(ordered_.keys) + bytes_of(touching_) + sunk_edges_.byte_count() +
         bytes_of(ordered_.stretches) + all_ordering_.byte_count() + nearest_keys_.byte_count();
}

}  // namespace graze
