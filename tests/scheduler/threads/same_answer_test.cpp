// This test compares reports from different numbers of threads, from several runs, and from a scene built
// afresh. All must be the same.

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t frame_count = 10 + repeats(20);
SceneSettings settings_for(ContactDetail detail, unsigned threads) {
  SceneSettings settings = settings_of(0.05, 0.25, detail);
  settings.threads = threads;
  return settings;
}

/// A contact by the bodies' numbers, the lower first: (body, body, kind, feature, feature).
using Named = std::tuple<std::size_t, std::size_t, ContactKind, Feature, Feature>;

/// Contacts and their distances, whichever object was added first. Without the one contact of a pair that
/// pierces: of its piercings `closest` names the smallest, which depends on which object is a.
std::vector<std::pair<Named, double>> contacts_of(const FrameReport& report, const MovingScene::Order& order,
                                                  ContactDetail detail) {
  std::vector<std::pair<Named, double>> contacts;
  for (const PairReport& pair : report.pairs())
    for (const Contact& contact : report.contacts(pair)) {
      if (detail == ContactDetail::closest && contact.distance == 0) continue;
      const std::size_t a = order[pair.a.index];
      const std::size_t b = order[pair.b.index];
      contacts.emplace_back(a < b ? Named(a, b, contact.kind, contact.feature_a, contact.feature_b)
                                  : Named(b, a, contact.kind, contact.feature_b, contact.feature_a),
                            contact.distance);
    }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace

TEST_CASE("the moving scene goes through every phase") {
  const MovingScene moving;
  std::set<PairPhase> phases;
  std::size_t contacts = 0;
  for (const ReportHandle& report : moving.play(settings_for(ContactDetail::features, 1), frame_count)) {
    CHECK(report->diagnostics().empty());
    CHECK(inconsistency_of(*report) == "");
    contacts += report->contacts().size();
    for (const PairReport& pair : report->pairs()) phases.insert(pair.phase);
  }
  CHECK(phases.size() == 4);
  CHECK(contacts > 1000);
}

TEST_CASE("reports are the same bit for bit for any number of threads and in every run") {
  const MovingScene moving;
  for (const ContactDetail detail : all_details) {
    const auto expected = moving.play(settings_for(detail, 1), frame_count);
    for (const unsigned threads : {1U, 2U, 3U, 8U, 0U}) {
      const auto found = moving.play(settings_for(detail, threads), frame_count);
      for (std::size_t frame = 0; frame < frame_count; ++frame) {
        INFO(threads << " threads, frame " << frame);
        REQUIRE(difference_of(*found[frame], *expected[frame]) == "");
        const StepStatistics& mine = found[frame]->statistics();
        const StepStatistics& theirs = expected[frame]->statistics();
        REQUIRE(mine.work.region_pairs_tested == theirs.work.region_pairs_tested);
        REQUIRE(mine.work.exact_decisions == theirs.work.exact_decisions);
        REQUIRE(mine.work.regions_expanded == theirs.work.regions_expanded);
        REQUIRE(mine.bytes.objects == theirs.bytes.objects);
        REQUIRE(mine.bytes.pairs == theirs.bytes.pairs);
        REQUIRE(mine.bytes.reports == theirs.bytes.reports);
      }
    }
  }
}

TEST_CASE("reports equal those of a scene built afresh in each frame") {
  const MovingScene moving;
  for (const ContactDetail detail : all_details) {
    const SceneSettings settings = settings_for(detail, 2);
    const auto reports = moving.play(settings, frame_count);
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
      INFO("frame " << frame);
      const ReportHandle afresh = moving.built_afresh(settings, frame);
      REQUIRE_FALSE(afresh->pairs().empty());
      REQUIRE(timeless_rows_of(*reports[frame], settings.range) == timeless_rows_of(*afresh, settings.range));
      REQUIRE(timeless_rows_of(*afresh, settings.range).size() == afresh->pairs().size());
    }
  }
}

TEST_CASE("phases follow from what scenes built afresh have in contact") {
  const MovingScene moving;
  const SceneSettings settings = settings_for(ContactDetail::features, 2);
  std::set<std::pair<ObjectId, ObjectId>> before;
  std::size_t ended = 0;
  moving.play(settings, frame_count, [&](std::size_t frame, const ReportHandle& report, const auto&) {
    const ReportHandle afresh = moving.built_afresh(settings, frame);
    std::set<std::pair<ObjectId, ObjectId>> now;
    for (const PairReport& pair : afresh->pairs())
      if (pair.phase == PairPhase::began) now.emplace(pair.a, pair.b);
    std::size_t listed = 0;
    for (const PairReport& pair : report->pairs()) {
      const bool is = now.contains({pair.a, pair.b});
      const bool was = before.contains({pair.a, pair.b});
      const PairPhase expected =
          is ? (was ? PairPhase::touching : PairPhase::began) : (was ? PairPhase::ended : PairPhase::near);
      REQUIRE(pair.phase == expected);
      listed += is || was ? 1U : 0U;
      ended += expected == PairPhase::ended ? 1U : 0U;
    }
    std::set<std::pair<ObjectId, ObjectId>> either = now;
    either.insert(before.begin(), before.end());
    REQUIRE(listed == either.size());  // every contact, and every end of one, is listed
    before = now;
  });
  CHECK(ended > 5);
}

TEST_CASE("objects added in another order have the same contacts") {
  const MovingScene moving;
  MovingScene::Order backwards = moving.given_order();
  std::reverse(backwards.begin(), backwards.end());
  MovingScene::Order mixed = moving.given_order();
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = (5 * i + 3) % mixed.size();
  std::size_t contacts = 0;
  for (std::size_t frame = 1; frame < frame_count; frame += 4)
    for (const ContactDetail detail :
         {ContactDetail::closest, ContactDetail::features, ContactDetail::vertices, ContactDetail::nearest}) {
      const SceneSettings settings = settings_for(detail, 2);
      const auto expected = contacts_of(*moving.built_afresh(settings, frame), moving.given_order(), detail);
      contacts += expected.size();
      for (const MovingScene::Order& order : {backwards, mixed}) {
        const auto found = contacts_of(*moving.built_afresh(settings, frame, order), order, detail);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          REQUIRE(found[i].first == expected[i].first);
          REQUIRE(std::abs(found[i].second - expected[i].second) <= 0x1p-48);
        }
      }
    }
  CHECK(contacts > 500);
}

}  // namespace graze::tests
