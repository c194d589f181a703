// The part of the search for contacts that finds the nearest of each vertex.

#include <algorithm>

#include "leaves/nearest_features.hpp"
#include "measure/measure.hpp"
#include "search/contact_search.hpp"

namespace graze {
namespace {

/// The most slices that share the vertices out among them.
constexpr std::size_t most_that_choose = 64;

}  // namespace

NearestFeatures ContactSearch::nearest_features_in(SearchSlice& slice, SearchWorker& worker) {
  worker.scratch.nearest_of_vertices.clear();
  FoundContacts& contacts = slice.contacts;
  const NearestFound found{contacts.keys, contacts.edges_if_sunk, contacts.piercing, contacts.fold,
                           worker.scratch.nearest_of_vertices};
  return {worker.pair, pair_.query.threshold, worker.scratch.features,
          found,       listing_in(slice),     touching_in(slice)};
}

/// Whether the nearest of each vertex is yet to be chosen out of what several slices have found.
bool ContactSearch::has_nearest_to_choose() const {
  return pair_.query.detail == ContactDetail::nearest && stage_ != Stage::nearest && slices_.size() > 1;
}

/// Ends a slice. If there are others, it keeps what it has found for the next stage, ordered by vertices.
void ContactSearch::keep_nearest(SearchSlice& slice, SearchWorker& worker) {
  if (!slice.complete) return;
  const auto found = worker.scratch.nearest_of_vertices.all();
  if (!has_nearest_to_choose())
    return append_below(worker.pair, found, threshold_now(worker), slice.contacts.keys);
  slice.contacts.of_vertices.assign(found.begin(), found.end());
  std::sort(slice.contacts.of_vertices.begin(), slice.contacts.of_vertices.end(),
            [](const VertexNearest& left, const VertexNearest& right) { return left.vertex < right.vertex; });
}

/// Finds the nearest of all folds. Slices kept theirs.
void ContactSearch::find_nearest_fold(SearchWorker& worker) {
  for (const SearchSlice& slice : slices_.all()) {
    if (!slice.contacts.fold) continue;
    if (fold_)
      keep_nearer(worker.pair, *fold_, *slice.contacts.fold);
    else
      fold_ = slice.contacts.fold;
  }
}

/// Answers for surfaces in contact at a fold alone: it is the one contact then.
SearchProgress ContactSearch::finish_at_fold(SearchWorker& worker) {
  set_distance(*pair_.answer, worker.pair, fold_->key);
  pair_.answer->in_contact = pair_.answer->listed = true;
  pair_.answer->contacts.assign(1, measure(worker.pair, fold_->key));
  return SearchProgress::answered;
}

/// Once all edges that pierce have been found. Several slices of the detail `nearest` have settled their
/// edges already.
void ContactSearch::find_sunk_edges(SearchWorker& worker) {
  if (!lists_piercings(pair_.query.detail) || stage_ == Stage::nearest) return;
  sunk_edges_.gather(slices_.all());
  if (slices_.size() == 1) sunk_edges_.settle(slices_.first().contacts, worker);
}

/// Gives each of the first slices a range of all vertices: those of a, then those of b.
SearchProgress ContactSearch::begin_nearest(SearchWorker& worker) {
  if (stage_ == Stage::listed) ++worker.meter.counters().pairs_by_list;
  stage_ = Stage::nearest;
  sunk_edges_.gather(slices_.all());
  const std::size_t vertices = std::size_t{pair_.a->mesh().vertex_count()} + pair_.b->mesh().vertex_count();
  const std::size_t parts = std::min(slices_.size(), most_that_choose);
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    slices_[i].begin = std::min(i, parts) * vertices / parts;
    slices_[i].end = std::min(i + 1, parts) * vertices / parts;
  }
  return SearchProgress::slices;
}

/// Reads what all slices have found of its vertices, and appends to its own keys. So it does with its edges.
void ContactSearch::run_nearest(SearchSlice& slice, SearchWorker& worker) {
  const std::size_t of_a = pair_.a->mesh().vertex_count();
  const auto vertex_at = [&](std::size_t i) {
    return i < of_a ? VertexOfPair::of_a(static_cast<std::uint32_t>(i))
                    : VertexOfPair::of_b(static_cast<std::uint32_t>(i - of_a));
  };
  const auto comes_before = [](const VertexNearest& nearest, VertexOfPair vertex) {
    return nearest.vertex < vertex;
  };
  sunk_edges_.settle(slice.contacts, worker);
  if (slice.begin == slice.end) return;
  const VertexOfPair begin = vertex_at(slice.begin);
  const VertexOfPair end = vertex_at(slice.end);
  NearestOfVertices& nearest = worker.scratch.nearest_of_vertices;
  nearest.clear();
  for (const SearchSlice& found : slices_.all()) {
    const auto& all = found.contacts.of_vertices;
    auto each = std::lower_bound(all.begin(), all.end(), begin, comes_before);
    for (; each != all.end() && each->vertex < end; ++each) nearest.offer(worker.pair, *each);
  }
  append_below(worker.pair, nearest.all(), threshold_now(worker), slice.contacts.keys);
}

}  // namespace graze
