// The search for contacts in AccuracyMode::paper.

#include "measure/measure.hpp"
#include "paper/paper.hpp"
#include "search/contacts/contact_search.hpp"

namespace graze {

SearchProgress ContactSearch::find_as_in_paper(SearchWorker& worker) {
  const PairQuery& query = pair_.query;
  PairAnswer& answer = *pair_.answer;
  SearchScratch& scratch = worker.scratch;
  std::vector<FeaturePairKey>& keys = ordered_.keys;
  answer.contacts.clear();
  keys.clear();
  const PaperFound found = graze::find_as_in_paper(worker.pair, query, scratch.paper, worker.meter, keys);
  if (!found.complete) return SearchProgress::gave_up;
  if (pair_.closest_kept() > 0) {
    nearest_keys_.begin(pair_.closest_kept());
    nearest_keys_.add(worker.pair, keys, scratch.measure, scratch.nearest_keys);
    nearest_keys_.finish(worker.pair, keys, scratch.lowest);
    answer.cut = nearest_keys_.is_cut();
  }
  for (const FeaturePairKey& key : keys) {
    worker.pair.check_time();
    answer.contacts.push_back(measure(worker.pair, key));
  }
  set_distance(answer, worker.pair, scratch.paper.closest.keys.front());
  answer.distance.lower = std::min(answer.distance.lower, found.lower);
  answer.in_contact = !keys.empty();
  answer.listed = answer.in_contact || answer.distance.lower < query.reach;
  return SearchProgress::answered;
}

}  // namespace graze
