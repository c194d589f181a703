#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "leaves/leaf_features.hpp"
#include "leaves/nearest_features.hpp"
#include "measure/nearest_keys.hpp"
#include "pair/near_listing.hpp"
#include "search/search_progress.hpp"
#include "search/search_slices.hpp"
#include "search/search_worker.hpp"
#include "search/searched_pair.hpp"
#include "search/sunk_edges.hpp"
#include "vertices/near_vertices.hpp"

namespace graze {

/// The search for all contacts of a detail: finds their keys, sorts them, and measures the contacts.
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
  /// The purpose of the slices that were made last.
  enum class Stage : std::uint8_t {
    listed,    ///< the keys of all contacts among features that an earlier query listed
    reach,     ///< pairs of leaves that may be in contact
    contacts,  ///< the keys of all contacts in them
    vertices,  ///< the keys of all pairs of vertices in blocks that may be near
    nearest,   ///< the nearest keys of each vertex, out of what slices have found
    ordered,   ///< all keys sorted, each once: one of the stretches that bins were cut into
    measured,  ///< the contacts themselves
  };
  /// A range of all keys, and from where they come; sorted those that are contacts.
  struct Stretch {
    std::size_t begin;
    std::size_t end;
    struct {
      std::size_t begin = 0;
      std::size_t end = 0;
    } runs;
    bool complete = true;
  };

  // Keys, from leaves or from blocks of vertices:
  SearchProgress begin_reach(SearchWorker& worker);
  void run_reach(SearchSlice& slice, SearchWorker& worker);
  SearchProgress begin_contacts(SearchWorker& worker);
  void cut_leaves();
  void run_contacts(SearchSlice& slice, SearchWorker& worker);
  template <typename Features>
  void test_leaves(SearchSlice& slice, SearchWorker& worker, Features& features);
  void add_closest_vertices(const LeafOf& a, const LeafOf& b, SearchSlice& slice, SearchWorker& worker) const;
  SearchProgress begin_vertices(SearchWorker& worker);
  void run_vertices(SearchSlice& slice, SearchWorker& worker);
  SearchProgress finish_keys(SearchWorker& worker);
  [[nodiscard]] auto may_touch() const;

  // Lists of near features:
  SearchProgress begin_listed(const NearList& near);
  void choose_list_slack();
  [[nodiscard]] bool is_listing() const { return list_slack_ > 0; }
  /// How near contacts are, or what is listed for the next steps.
  [[nodiscard]] double wanted() const { return pair_.query.threshold + list_slack_; }
  [[nodiscard]] NearListing listing_in(SearchSlice& slice) const;
  [[nodiscard]] TouchingEdges* touching_in(SearchSlice& slice) const;
  void run_listed(SearchSlice& slice, SearchWorker& worker);
  template <typename Features>
  void test_listed(SearchSlice& slice, SearchWorker& worker, Features& features);
  void keep_list(SearchWorker& worker);

  // The nearest of each vertex. Each slice finds its own, then each takes some vertices out of all slices:
  [[nodiscard]] NearestFeatures nearest_features_in(SearchSlice& slice, SearchWorker& worker);
  [[nodiscard]] bool has_nearest_to_choose() const;
  void keep_nearest(SearchSlice& slice, SearchWorker& worker);
  SearchProgress begin_nearest(SearchWorker& worker);
  void find_nearest_fold(SearchWorker& worker);
  SearchProgress finish_at_fold(SearchWorker& worker);
  void find_sunk_edges(SearchWorker& worker);
  void run_nearest(SearchSlice& slice, SearchWorker& worker);

  // A limit of contacts. Slices hand their keys over to one list of the nearest. The detail `nearest` keeps
  // the deepest instead, and which they are is known only when all have been measured:
  [[nodiscard]] bool is_limited() const {
    return pair_.query.contact_limit > 0 && pair_.query.detail != ContactDetail::nearest;
  }
  [[nodiscard]] double threshold_now(SearchWorker& worker);
  void hand_over(SearchSlice& slice, SearchWorker& worker);
  void hand_over_if_many(SearchSlice& slice, SearchWorker& worker);
  SearchProgress finish_nearest(SearchWorker& worker);

  // Sorted keys, and contacts:
  void bin_keys(SearchSlice& slice, SearchWorker& worker);
  SearchProgress begin_ordering();
  void order(Stretch& stretch, SearchWorker& worker);
  [[nodiscard]] std::size_t sort_keys(std::span<FeaturePairKey> keys, SearchWorker& worker) const;
  SearchProgress begin_measuring(SearchWorker& worker);
  [[nodiscard]] SearchProgress finish_without_contacts(SearchWorker& worker);
  void keep_time_back(std::size_t contacts, SearchWorker& worker);
  void run_measured(SearchSlice& slice, SearchWorker& worker);
  SearchProgress finish_measuring(SearchWorker& worker);
  [[nodiscard]] std::span<const FeaturePairKey> keys_of(const SearchSlice& slice) const;
  [[nodiscard]] std::span<Contact> contacts_of(const SearchSlice& slice) const;
  [[nodiscard]] FeaturePairKey lowest_measured(SearchWorker& worker) const;
  [[nodiscard]] static FeaturePairKey lower_of(SearchWorker& worker, const FeaturePairKey& left,
                                               const FeaturePairKey& right);

  SearchedPair& pair_;
  SearchSlices& slices_;
  NearBlocks& near_blocks_;
  Stage stage_ = Stage::reach;
  bool is_from_front_ = false;   ///< the pairs of leaves come from the last query's front, not from a walk
  double list_slack_ = 0;        ///< `PairQuery::list_slack` where a new near list is made, otherwise 0
  TouchingEdges touching_;       ///< of all slices, where the pair has a solid
  SunkEdges sunk_edges_;         ///< by the edges that pierce of all slices
  std::optional<NearKey> fold_;  ///< the nearest where one feature is a fold, for `ContactDetail::nearest`
  std::vector<FeaturePairKey> keys_;
  NearestKeys nearest_keys_;                           ///< of all slices, where contacts are limited
  std::optional<FeaturePairKey> lowest_;               ///< the nearest of all, where contacts are limited
  std::vector<Stretch> stretches_;                     ///< of `keys_`
  std::vector<std::span<const FeaturePairKey>> runs_;  ///< of the slices' keys, by bins
};

}  // namespace graze
