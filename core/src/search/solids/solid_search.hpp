#pragma once

#include <cstddef>
#include <span>

#include "leaves/touching_edges.hpp"
#include "search/workers/search_progress.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"

namespace graze {

/// Completes the answer about a pair with a solid, on one thread: which vertices of one object are inside the
/// other, the contacts of `ContactDetail::nearest` there, and the sides of its contacts.
class SolidSearch {
 public:
  /// `touching` lists the edges that touch. It is null where the search has not found them; then they are
  /// looked for where surfaces touch.
  SolidSearch(SearchedPair& pair, SearchWorker& worker, const TouchingEdges* touching)
      : pair_(pair), worker_(worker), scratch_(worker.scratch.solid), touching_(touching) {}

  /// Makes the reach infinite if something is inside, of surfaces that are no nearer than the threshold. What
  /// is inside is in contact, and needs a distance. Returns false if the budget is spent.
  [[nodiscard]] bool widen_reach();
  /// Completes the answer. Says `no_contact` if something is inside and the distance is not known: then the
  /// closest points are wanted before, and the reach is infinite.
  SearchProgress complete();

 private:
  [[nodiscard]] bool find_inside(double apart);
  [[nodiscard]] bool has_some() const;
  [[nodiscard]] bool knows_inside() const;
  void repeat_inside();
  [[nodiscard]] bool find_touching(double apart);
  [[nodiscard]] Inside state(bool pierced) const;
  void remember_inside(double apart) const;
  void add_contacts_inside();
  void list_keys_inside();
  void merge_contacts();
  void set_sides() const;
  void turn_pushes() const;
  [[nodiscard]] bool leads_in(const Contact& contact) const;

  SearchedPair& pair_;
  SearchWorker& worker_;
  SolidScratch& scratch_;
  const TouchingEdges* touching_;
};

}  // namespace graze
