#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "core/mesh/pair_room.hpp"
#include "leaves/nearest_of_vertices.hpp"
#include "leaves/touching_edges.hpp"
#include "measure/nearest_keys.hpp"
#include "search/contacts/contact_measuring.hpp"
#include "search/contacts/contact_sources.hpp"
#include "search/contacts/key_finders.hpp"
#include "search/contacts/key_ordering.hpp"
#include "search/contacts/near_list_recorder.hpp"
#include "search/contacts/nearest_choice.hpp"
#include "search/contacts/sunk_edges.hpp"
#include "search/workers/search_progress.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"
#include "vertices/near_vertices.hpp"

namespace graze {

/// The search for all contacts of a detail, in four stages: it finds candidates, collects the keys of
/// contacts among them, orders the keys, and measures the contacts. It is put together when it begins:
///
/// - a source gives the candidates (contact_sources.hpp).
/// - a finder says which keys the detail has of them (key_finders.hpp).
/// - a collector takes all keys, or the closest (key_collectors.hpp). An ordering goes with it
///   (key_ordering.hpp).
/// - observers watch: they list features that are near, and edges that touch or pierce.
class ContactSearch {
 public:
  ContactSearch(SearchedPair& pair, SearchSlices& slices, NearBlocks& near_blocks)
      : pair_(pair), slices_(slices), near_blocks_(near_blocks) {}

  SearchProgress begin(SearchWorker& worker);
  /// Answers in AccuracyMode::paper, at once.
  SearchProgress find_as_in_paper(SearchWorker& worker);
  /// Puts the results of the stage together, whose slices have all been run, and begins the next.
  SearchProgress next_stage(SearchWorker& worker);
  /// How many slices the stage has.
  [[nodiscard]] std::size_t slice_count() const;
  [[nodiscard]] bool& is_complete(std::size_t index);
  void run(std::size_t index, SearchWorker& worker);

  /// The edges that touch, of a pair with a solid, once all keys have been found. It is null if the search
  /// does not find all of them.
  [[nodiscard]] const TouchingEdges* touching() const {
    return lists_piercings(pair_.query.detail) && pair_.query.groups == nullptr ? &touching_ : nullptr;
  }

  /// Makes room in the slice of a pair that is not cut, for all that it can find before the deadline.
  void make_room_until_deadline(SearchWorker& worker);
  void reserve_as(const ContactSearch& other);
  void reserve(const PairRoom& room);
  void reserve_for_solids();
  void reserve_for_limit(std::size_t most, const PairRoom& room);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  enum class Stage : std::uint8_t {
    find,     ///< the source finds candidates
    collect,  ///< the keys of contacts among them
    choose,   ///< still that: those keys that only all slices together can tell
    order,    ///< all keys sorted, each once; only keys of many slices take a stage
    measure,  ///< the contacts themselves
  };

  // The parts that a search is put together of:
  void choose_parts();
  template <typename Finder>
  void choose_parts_for();
  template <typename Finder>
  void choose_source(bool nearest_first);

  // How the stages follow each other:
  SearchProgress begin_collecting(SearchWorker& worker);
  template <typename Finder>
  void collect_all(SearchSlice& slice, SearchWorker& worker);
  template <typename Finder>
  void collect_closest(SearchSlice& slice, SearchWorker& worker);
  [[nodiscard]] FinderInput input_of(SearchSlice& slice, SearchWorker& worker);
  template <typename Collector>
  void feed(SearchSlice& slice, SearchWorker& worker, Collector& collector);
  [[nodiscard]] bool has_choice() const { return leaves_choice_ && slices_.size() > 1; }
  SearchProgress end_collecting(SearchWorker& worker);
  SearchProgress begin_ordering(SearchWorker& worker);
  SearchProgress begin_measuring(SearchWorker& worker);
  [[nodiscard]] SearchProgress finish_without_contacts(SearchWorker& worker);
  SearchProgress finish_at_fold(SearchWorker& worker);
  SearchProgress finish(SearchWorker& worker);

  SearchedPair& pair_;
  SearchSlices& slices_;
  NearBlocks& near_blocks_;
  OrderedKeys ordered_;
  NearestKeys nearest_keys_;  ///< of all slices, where contacts are limited
  TouchingEdges touching_;    ///< of all slices, where the pair has a solid
  SunkEdges sunk_edges_;      ///< by the edges that pierce of all slices
  AllOrdering all_ordering_{pair_, slices_, ordered_};
  ClosestOrdering closest_ordering_{pair_, slices_, ordered_, nearest_keys_};
  NearestChoice choice_{pair_, slices_, sunk_edges_};
  ContactMeasuring measuring_{pair_, slices_, ordered_};

  // The parts of this search:
  NearListRecorder recorder_{pair_};
  ContactSource source_{std::in_place_type<ListSource>, pair_, slices_};
  void (ContactSearch::*collect_)(SearchSlice&, SearchWorker&) = nullptr;
  KeyOrdering* ordering_ = nullptr;
  bool leaves_choice_ = false;  ///< the finder leaves keys for the stage `choose`

  Stage stage_ = Stage::find;
  std::optional<NearKey> fold_;  ///< the nearest where one feature is a fold, for `ContactDetail::nearest`
};

}  // namespace graze
