#include "search/contacts/sunk_edges.hpp"

#include <algorithm>

#include "core/base/growth_policy.hpp"
#include "measure/measure_batch.hpp"

namespace graze {
namespace {

bool are_behind_each_other(const Contact& contact) {
  return contact.side_a == Side::back && contact.side_b == Side::back;
}

}  // namespace

void SunkEdges::gather(std::span<const SearchSlice> slices, bool are_of_self) {
  piercing_.clear();
  for (const SearchSlice& slice : slices)
    if (!slice.contacts.piercing.empty()) piercing_.add(slice.contacts.piercing);
  if (piercing_.empty()) return;
  piercing_.sort();
  if (are_of_self) piercing_.of_b = piercing_.of_a;
}

void SunkEdges::settle(FoundContacts& found, SearchWorker& worker) const {
  std::vector<EdgesIfSunk>& undecided = found.edges_if_sunk;
  if (undecided.empty()) return;
  // Few pairs have an edge that pierces. Only of these it matters on which sides they are.
  const auto open = std::partition(undecided.begin(), undecided.end(), [&](const EdgesIfSunk& edges) {
    return !piercing_.has_one(edges.key.index_a(), edges.key.index_b());
  });
  for (auto edges = undecided.begin(); edges != open; ++edges)
    if (!edges->if_sunk) found.keys.push_back(edges->key);
  auto& [contacts, keys] = worker.scratch.settled_edges;
  keys.clear();
  for (auto edges = open; edges != undecided.end(); ++edges) keys.push_back(edges->key);
  resize_to_overwrite(contacts, keys.size());
  measure(worker.pair, keys, contacts, worker.scratch.measure);
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (are_behind_each_other(contacts[i]) == open[static_cast<std::ptrdiff_t>(i)].if_sunk)
      found.keys.push_back(keys[i]);
}

void SunkEdges::mark(std::span<Contact> contacts) const {
  if (piercing_.empty()) return;
  for (Contact& contact : contacts)
    contact.sunk = contact.kind == ContactKind::EE && are_behind_each_other(contact) &&
                   piercing_.has_one(contact.feature_a.index, contact.feature_b.index);
}

}  // namespace graze
