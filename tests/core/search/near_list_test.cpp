// Lists of the features that are near replace a search while the surfaces hardly move. Every answer is that
// of a query that knows nothing of the steps before, and most need no search.

#include <array>
#include <iostream>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

struct ListTally {
  std::size_t answers = 0;
  std::size_t by_list = 0;
  std::size_t contacts = 0;
  std::size_t piercings = 0;
  std::size_t changes = 0;  ///< steps with other contacts than the one before, by a list

  void add(const PairAnswer& answer, const std::vector<Contact>& last, bool was_by_list) {
    ++answers;
    by_list += was_by_list ? 1 : 0;
    contacts += answer.contacts.size();
    bool same = last.size() == answer.contacts.size();
    for (std::size_t i = 0; i < answer.contacts.size(); ++i) {
      const Contact& contact = answer.contacts[i];
      piercings += contact.kind == ContactKind::EF && contact.distance == 0 ? 1 : 0;
      same = same && contact.feature_a == last[i].feature_a && contact.feature_b == last[i].feature_b;
    }
    changes += was_by_list && !same ? 1 : 0;
  }
};

/// Answers a pair as scenes do, whether in slices or not.
class Asking {
 public:
  explicit Asking(bool sliced) : sliced_(sliced) {}

  const PairAnswer& ask(const Surface& a, const Surface& b, const PairQuery& query, PairCounters& counters) {
    if (!sliced_) {
      detector_.detect(a, b, query, front_, answer_, counters);
      return answer_;
    }
    large_.begin(a, b, query, front_, answer_);
    while (!large_.advance(detector_, counters))
      for (std::size_t i = large_.slice_count(); i-- > 0;) large_.run_slice(i, detector_, counters);
    return answer_;
  }
  [[nodiscard]] const LeafFront& front() const { return front_; }

 private:
  bool sliced_;
  LeafFront front_;
  PairDetector detector_;
  LargePair large_;
  PairAnswer answer_;
};

void play(const DriftingPair& rest, const PairQuery& query, double tremor, bool sliced, ListTally& tally) {
  Surface a = surface_of(rest.a);
  Surface b = surface_of(rest.b);
  Asking asking(sliced);
  std::vector<Contact> last;
  for (int step = 0; step < 14; ++step) {
    const auto seed = static_cast<std::uint64_t>(step);
    const Eigen::Vector3d way(rest.apart + step * rest.drift, 0.03, 0.02);
    REQUIRE(a.set_positions(wobbled(rest.a, tremor, seed).positions).taken());
    REQUIRE(b.set_positions(mapped(wobbled(rest.b, tremor, seed + 50), 1, way).positions).taken());
    a.make_blocks();
    b.make_blocks();
    INFO(rest.name << ", step " << step << ", tremor " << tremor << ", threshold " << query.threshold);
    PairQuery alone = query;
    alone.list_slack = 0;
    const PairAnswer afresh = detect(a, b, alone);
    PairCounters counters;
    const PairAnswer& answer = asking.ask(a, b, query, counters);
    check_same(answer, afresh);
    REQUIRE(counters.pairs_by_list <= 1);
    if (counters.pairs_by_list == 1 && answer.in_contact) REQUIRE(counters.leaf_pairs_tested == 0);
    tally.add(answer, last, counters.pairs_by_list == 1);
    last = answer.contacts;
  }
}

std::vector<DriftingPair> rests() {
  const Shape ball = shape_of(models::sphere(18, 12));
  const Shape ring = shape_of(models::torus(18, 10, 0.7, 0.3));
  const Shape block = shape_of(models::box({1, 1, 1}));
  const Shape of_quads = shape_of(models::sphere(16, 12, models::Faces::quads));
  const Shape sheet = shape_of(models::sheet(12, 12, 1.5, 1.5, models::Faces::quads));
  return {{"balls apart", ball, turned(ball, 3), 2.02, 0},
          {"balls through each other", ball, turned(ball, 3), 1.9, 1e-4},
          {"rings within each other", ring, turned(ring, 5), 0.05, 1e-4},
          {"blocks", block, block, 1.001, 0},
          {"balls that part", ball, turned(ball, 4), 1.985, 1e-3},
          {"balls that meet", ball, turned(ball, 4), 2.02, -2e-3},
          {"balls of quads", of_quads, turned(of_quads, 6), 1.97, 1e-4},
          {"warped sheets", turned(sheet, 7), turned(sheet, 8), 0.02, 1e-4},
          {"a sheet through a ball", turned(sheet, 9), of_quads, 0.9, 1e-4}};
}

}  // namespace

TEST_CASE("near list: what is listed spares searches, and shows in no answer") {
  const FloatingPointScope scope;
  for (const ContactDetail detail :
       {ContactDetail::features, ContactDetail::vertices, ContactDetail::nearest}) {
    ListTally tally;
    for (const DriftingPair& rest : rests())
      for (const double threshold : {0.0, 0.02, 0.25})
        for (const double tremor : {0.0, 1e-6, 3e-4}) {
          if (detail == ContactDetail::vertices && threshold == 0) continue;
          PairQuery query = query_of(detail, threshold);
          query.reach = threshold + 0.2;
          query.slack = 0.1;
          query.list_slack = 6 * (2 * tremor + std::abs(rest.drift)) + 1e-7;
          play(rest, query, tremor, false, tally);
        }
    CHECK(tally.contacts > 10'000);
    CHECK(tally.by_list * 3 > tally.answers * 2);
    CHECK(tally.changes > 40);
    if (detail == ContactDetail::features) CHECK(tally.piercings > 1000);
    std::cout << tally.by_list << " of " << tally.answers << " answers by lists, " << tally.contacts
              << " contacts, " << tally.piercings << " piercings, " << tally.changes << " changes\n";
  }
}

TEST_CASE("near list: large pairs' slices list what one search does") {
  const FloatingPointScope scope;
  const Shape ball = shape_of(models::sphere(80, 60));
  const std::array all{
      DriftingPair{"through each other", ball, turned(ball, 3), 1.97, 1e-5},
      DriftingPair{"about each other", ball, mapped(turned(ball, 4), 0.99, {0, 0, 0}), 0, 1e-5}};
  for (const ContactDetail detail :
       {ContactDetail::features, ContactDetail::vertices, ContactDetail::nearest}) {
    ListTally tally;
    for (const DriftingPair& rest : all) {
      PairQuery query = query_of(detail, 0.02);
      query.slack = 0.01;
      query.list_slack = 1e-3;
      play(rest, query, 1e-5, true, tally);
    }
    CHECK(tally.by_list * 4 > tally.answers * 3);
    CHECK(tally.contacts > 10'000);
  }
}

TEST_CASE("near list: one that is too long is not kept, nor tried again while nothing moves") {
  const FloatingPointScope scope;
  const Shape ball = shape_of(models::sphere(24, 18));
  const Surface a = surface_of(ball);
  const Surface b = surface_of(mapped(turned(ball, 3), 1, {1.95, 0, 0}));
  PairQuery query = query_of(ContactDetail::features, 0.05);
  query.slack = query.list_slack = 0.01;
  PairDetector detector;
  PairAnswer answer;
  LeafFront front;
  PairCounters counters;
  detector.detect(a, b, query, front, answer, counters);
  const std::size_t listed = front.near->pairs.size();
  REQUIRE(listed > answer.contacts.size());
  CHECK(front.near->serves(a, b, query.threshold));
  // A list serves what is asked of it up to where it was made for.
  CHECK(front.near->serves(a, b, query.threshold + 0.009));
  CHECK_FALSE(front.near->serves(a, b, query.threshold + 0.011));
  // At a lower threshold no further than until edges that are not listed may pierce.
  CHECK(front.near->serves(a, b, 0));
  Surface moved = b;
  REQUIRE(moved.set_positions(mapped(turned(ball, 3), 1, {1.93, 0, 0}).positions).taken());
  CHECK_FALSE(front.near->serves(a, moved, 0));

  query.front_limit = listed - 1;
  LeafFront other;
  for (const std::uint64_t left_out : {1U, 1U, 1U}) {
    PairCounters of_this;
    detector.detect(a, b, query, other, answer, of_this);
    CHECK(of_this.pairs_by_list == 0);
    CHECK(other.near == nullptr);
    CHECK(counters.fronts_left_out <= left_out);
    counters.fronts_left_out += of_this.fronts_left_out;
  }
  CHECK(counters.fronts_left_out == 1);
  query.list_slack = 0;
  detector.detect(a, b, query, other, answer, counters);
  CHECK_FALSE(other.list_is_too_long);
}

}  // namespace graze::tests
