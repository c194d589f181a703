#pragma once

#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "closest_features/key_bins.hpp"
#include "closest_features/key_order.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "leaves/leaf_feature_pairs.hpp"
#include "measure/measure_batch.hpp"
#include "measure/nearest_keys.hpp"
#include "measure/parallel.hpp"
#include "pair/near_listing.hpp"
#include "paper/paper.hpp"
#include "vertices/near_vertices.hpp"
#include "walk/closest_range.hpp"
#include "walk/leaf_pairs.hpp"
#include "walk/touching_order.hpp"

namespace graze {

/// Working memory of one thread.
struct SearchScratch {
  LeafPairScratch leaf_pairs;
  NearVerticesScratch vertices;
  LeafScratch features;
  Closest nearest_of_leaves;
  PaperScratch paper;
  Closest lowest;
  ParallelScratch parallel;
  KeyBinning binning;
  KeyOrder order;
  MeasureScratch measure;
  NearestKeysScratch nearest_keys;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.leaf_pairs, self.vertices, self.features, self.nearest_of_leaves, self.paper,
                    self.lowest, self.parallel, self.binning, self.order, self.measure, self.nearest_keys);
  }
};

/// One query about one pair of surfaces: DMV, DV and contact determination, as stages of slices. A slice
/// reads what the stage has in common and writes its own results, so slices may run on any threads in any
/// order. Between stages `advance` puts the slices' results together in their order. How a stage is cut
/// depends on the surfaces and the query only, so the answer does not depend on who ran what.
class PairSearch {
 public:
  /// Begins a query. The arguments that are pointed to have to stay until it is answered. `sliced`: a stage
  /// may be cut into many slices.
  void begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front, PairAnswer& answer,
             bool sliced);

  /// Goes on to the next stage of several slices; true when the answer is there instead. Otherwise each of
  /// the slices below `slice_count` is to be run once, and then this called again.
  bool advance(SearchScratch& scratch, PairCounters& counters);
  [[nodiscard]] std::size_t slice_count() const {
    return stage_ == Stage::ordered ? stretches_.size() : slice_count_;
  }
  void run_slice(std::size_t index, SearchScratch& scratch, PairCounters& counters);

  /// Reserves as much as another search has. Neither is cut into slices.
  void reserve_as(const PairSearch& other);
  void reserve(const PairRoom& room);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The purpose of the slices that were made last.
  enum class Stage : std::uint8_t {
    start,
    listed,    ///< the keys of all contacts among features that an earlier query listed
    reach,     ///< pairs of leaves that may be in contact
    contacts,  ///< the keys of all contacts in them
    vertices,  ///< the keys of all pairs of vertices in blocks that may be near
    ordered,   ///< all keys sorted, each once: one of the stretches that bins were cut into
    measured,  ///< the contacts themselves
    approach,  ///< pairs of leaves where the closest points may be
    closest,   ///< the closest points in them
    done,
  };
  struct Slice {
    std::span<const RegionPair> start;  ///< where to walk from
    std::size_t begin = 0;              ///< a range of a front, a list, of leaf pairs, of blocks or of keys
    std::size_t end = 0;
    std::size_t first_contact = 0;  ///< where those of a range of keys begin
    bool complete = true;
    LeafPairList found;
    std::vector<FeaturePair> near;
    bool near_is_too_long = false;  ///< and was forgotten
    std::vector<FeaturePairKey> keys;
    std::vector<BinRun> runs;  ///< of `keys`, where there are many slices
    double nearest = 0;        ///< of the contacts that were measured
    ClosestFound closest;
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
  class Worker;

  void go_on(Worker& worker);
  void next_stage(Worker& worker);
  void run(std::size_t index, Worker& worker);
  void run(Slice& slice, Worker& worker);
  void give_up();
  void as_in_paper(Worker& worker);

  [[nodiscard]] bool is_limited() const { return query_.contact_limit > 0; }
  [[nodiscard]] double threshold_now(Worker& worker);
  void hand_over(Slice& slice, Worker& worker);
  void hand_over_if_many(Slice& slice, Worker& worker);
  void run_vertices(Slice& slice, Worker& worker);

  void begin_contact(Worker& worker);
  void begin_listing();
  [[nodiscard]] NearListing listing_in(Slice& slice) const;
  void run_listed(Slice& slice, Worker& worker);
  void keep_list(Worker& worker);
  void begin_vertices(Worker& worker);
  void run_reach(Slice& slice, Worker& worker);
  void begin_contacts(Worker& worker);
  void run_contacts(Slice& slice, Worker& worker);
  void add_closest_vertices(const LeafOf& a, const LeafOf& b, Slice& slice, Worker& worker) const;
  void finish_contacts(Worker& worker);
  void bin_keys(Slice& slice, Worker& worker);
  void finish_nearest(Worker& worker);
  void begin_ordering();
  void order(Stretch& stretch, Worker& worker);
  [[nodiscard]] std::size_t sort_keys(std::span<FeaturePairKey> keys, Worker& worker) const;
  void begin_measuring(Worker& worker);
  void keep_time_back(std::size_t contacts, Worker& worker);
  void run_measured(Slice& slice, Worker& worker);
  void finish_measuring(Worker& worker);
  [[nodiscard]] std::span<const FeaturePairKey> keys_of(const Slice& slice) const;
  [[nodiscard]] std::span<Contact> contacts_of(const Slice& slice) const;
  [[nodiscard]] FeaturePairKey lowest_measured(Worker& worker) const;
  [[nodiscard]] bool may_touch(double lower) const;
  [[nodiscard]] auto may_touch_within_slack() const;

  void begin_approach(Worker& worker);
  void approach_vertices(Worker& worker);
  void begin_search(Worker& worker);
  void find_touching(Worker& worker);
  void test_front(Worker& worker);
  void walk_touching(Worker& worker);
  [[nodiscard]] bool test_overlapping(const RegionPair& start, const TouchingOrder& order,
                                      ClosestRange& range, Worker& worker);
  [[nodiscard]] TouchingOrder touching_order() const;
  [[nodiscard]] auto offering_middles(ClosestRange& range) const;
  void approach(Worker& worker);
  void run_approach(Slice& slice, Worker& worker);
  void begin_closest(Worker& worker);
  bool test_leaves(std::size_t begin, std::size_t end, ClosestFound& found, Worker& worker);
  bool test_leaves(LeafPair& leaves, ClosestRange& range, Worker& worker) const;
  void take_up_closest(Worker& worker);
  void finish_closest(Worker& worker);
  void set_apart();
  void report_closest(Worker& worker);
  void seed(Slice& slice) const;

  Slice& add_slice();
  void add_slices_of(std::span<const RegionPair> pairs, std::size_t each);
  void add_slices_of(std::size_t begin, std::size_t end, std::size_t each);
  void slice_front();
  void select_from_front(Slice& slice, double distance, Worker& worker) const;
  void slice_leaves_in_contact();
  template <typename Keep, typename Meet>
  void slice_walk(Worker& worker, const Keep& keep, const Meet& meet);
  void gather_found();
  void remember(double wanted, Worker& worker);
  void sort_front();
  void set_distance(Worker& worker, const FeaturePairKey& nearest);
  [[nodiscard]] Ties ties() const;
  [[nodiscard]] bool about_vertices() const { return is_about_vertices(query_.detail); }

  const Surface* a_ = nullptr;
  const Surface* b_ = nullptr;
  PairQuery query_;
  LeafFront* front_ = nullptr;
  PairAnswer* answer_ = nullptr;
  bool sliced_ = false;
  double wanted_ = 0;             ///< how near contacts are, or what is listed for the next steps
  bool is_listing_ = false;       ///< all that is as near
  bool from_front_ = false;       ///< the slices begin at the last query's front
  bool certainly_apart_ = false;  ///< by that front, in a search for the closest points
  double unlisted_lower_bound_ = -1;
  bool is_bounded_ = false;     ///< by the last answer, so that middle vertices need not be asked
  bool only_touching_ = false;  ///< the search for the closest points is for those at distance 0

  Stage stage_ = Stage::done;
  std::vector<Slice> slices_;  ///< kept longer than `slice_count_` for their memory
  std::size_t slice_count_ = 0;
  std::vector<RegionPair> roots_;  ///< where the slices walk from
  LeafPairList found_;
  NearBlocks near_blocks_;
  std::vector<FeaturePairKey> keys_;
  NearestKeys nearest_keys_;                           ///< of all slices, where contacts are limited
  FeaturePairKey lowest_;                              ///< the nearest of all, where contacts are limited
  std::vector<Stretch> stretches_;                     ///< of these
  std::vector<std::span<const FeaturePairKey>> runs_;  ///< of the slices' keys, by bins
  ClosestFound closest_;
};

}  // namespace graze
