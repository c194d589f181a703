#pragma once

#include <cstddef>
#include <graze/contact.hpp>
#include <span>
#include <vector>

#include "leaves/nearest_features.hpp"
#include "leaves/piercing_edges.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"

namespace graze {

/// Says which pairs of edges are sunk (Contact::sunk), once a search has found all edges that pierce a face.
/// They tell which of the pairs are contacts that `ContactDetail::nearest` lists only if they are sunk, or
/// only if they are not.
class SunkEdges {
 public:
  void clear() { piercing_.clear(); }
  /// Takes the edges that pierce from all slices. Those of one surface with itself count on both sides.
  void gather(std::span<const SearchSlice> slices, bool are_of_self);
  /// Appends those of a slice's pairs to its keys that turn out to be contacts. Any number of threads, one
  /// for each slice.
  void settle(FoundContacts& found, SearchWorker& worker) const;
  /// Sets Contact::sunk. Any number of threads, each for contacts of its own.
  void mark(std::span<Contact> contacts) const;

  void reserve(std::size_t edges) { piercing_.reserve(edges); }
  void reserve_as(const SunkEdges& other) { graze::reserve_as(piercing_, other.piercing_); }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(piercing_); }

 private:
  PiercingEdges piercing_;  ///< sorted
};

}  // namespace graze
