#include "search/contacts/contact_sources.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/cut_by_work.hpp"

namespace graze {
namespace {

constexpr std::size_t leaf_pairs_each = 8;
constexpr std::size_t listed_each = 1024;
constexpr std::size_t blocks_each = 64;

}  // namespace

/// Cuts the leaf pairs found so that every slice has as many to test.
void LeafSource::cut() {
  slices_->clear();
  auto& leaves = slices_->found().leaves;
  if (nearest_first_)
    std::sort(leaves.begin(), leaves.end(), [](const LeafPair& left, const LeafPair& right) {
      return std::tie(left.lower, left.pair.a, left.pair.b) <
             std::tie(right.lower, right.pair.a, right.pair.b);
    });
  if (!slices_->may_cut()) return slices_->add_range(0, leaves.size(), leaves.size());
  cut_by_work(
      0, leaves.size(), leaf_pairs_each, [&](std::size_t i) { return wanted_(leaves[i].lower, 0) ? 1U : 0U; },
      [&](std::size_t begin, std::size_t end) { slices_->add_range(begin, end, end - begin); });
}

SearchProgress WalkSource::begin(SearchWorker& worker) {
  slices_->walk(worker, wanted_, [](const RegionPair&) {});
  return SearchProgress::slices;
}

void WalkSource::find(SearchSlice& slice, SearchWorker& worker) const {
  if (slice.start.empty()) return;
  slice.complete = worker.leaf_pairs.walk(
      slice.start, wanted_, [](const RegionPair&) {}, slice.found);
}

void WalkSource::cut(SearchWorker& worker) {
  slices_->gather_found();
  slices_->keep_front(wanted_.distance, worker);
  LeafSource::cut();
}

SearchProgress FrontSource::begin(SearchWorker& /*worker*/) {
  slices_->cut_front();
  return SearchProgress::slices;
}

void FrontSource::find(SearchSlice& slice, SearchWorker& worker) const {
  worker.leaf_pairs.select_from(*pair_->front, slice.begin, slice.end, wanted_.distance, false, slice.found);
}

void FrontSource::cut(SearchWorker& /*worker*/) {
  slices_->gather_found();
  LeafSource::cut();
}

SearchProgress ListSource::begin(SearchWorker& /*worker*/) {
  pair_->front->walked = false;
  slices_->clear();
  return SearchProgress::slices;
}

void ListSource::cut(SearchWorker& /*worker*/) {
  slices_->add_range(0, pair_->front->near->pairs.size(), listed_each);
}

SearchProgress BlockSource::begin(SearchWorker& worker) {
  if (!worker.meter.spend()) return SearchProgress::gave_up;
  NearVertices(worker.pair, distance_, *blocks_, worker.scratch.vertices).find_blocks();
  pair_->front->walked = false;
  slices_->clear();
  return SearchProgress::slices;
}

void BlockSource::cut(SearchWorker& /*worker*/) {
  slices_->add_range(0, blocks_->a.count, blocks_each);
}

}  // namespace graze
