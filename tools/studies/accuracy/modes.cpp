#include "accuracy/modes.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <tuple>

namespace graze::tools {
namespace {

bool precedes(const Contact& left, const Contact& right) {
  return std::tie(left.kind, left.feature_a, left.feature_b) <
         std::tie(right.kind, right.feature_a, right.feature_b);
}

/// How many names two sorted lists of contacts share.
std::uint64_t common_count(std::span<const Contact> left, std::span<const Contact> right) {
  std::uint64_t count = 0;
  auto other = right.begin();
  for (const Contact& contact : left) {
    while (other != right.end() && precedes(*other, contact)) ++other;
    if (other != right.end() && !precedes(contact, *other)) ++count;
  }
  return count;
}

bool is_in_contact(const PairReport& pair) {
  return pair.complete && (pair.phase == PairPhase::began || pair.phase == PairPhase::touching);
}

/// The row of the same two objects, or none where they are not within the setting's range.
const PairReport* same_pair(const FrameReport& report, const PairReport& pair) {
  const auto found = std::ranges::find_if(
      report.pairs(), [&](const PairReport& row) { return row.a == pair.a && row.b == pair.b; });
  return found == report.pairs().end() ? nullptr : &*found;
}

}  // namespace

double ModeResult::recall() const {
  return share(contacts_found, contacts_true);
}

double ModeResult::precision() const {
  return share(contacts_below, contacts_reported);
}

ModeStudy::ModeStudy(const MovingSurfaces& bodies, double contact_distance)
    : bodies_(bodies),
      contact_distance_(contact_distance),
      features_(run(exact_settings(ContactDetail::features, contact_distance)).reports),
      regions_(run(exact_settings(ContactDetail::regions, contact_distance)).reports),
      vertices_(run(exact_settings(ContactDetail::vertices, contact_distance)).reports) {}

ModeStudy::Run ModeStudy::run(const SceneSettings& settings) const {
  Scene scene(settings);
  std::vector<ObjectId> ids;
  for (std::size_t body = 0; body < bodies_.size(); ++body) ids.push_back(scene.add(bodies_.mesh(body)));
  Run run;
  for (std::uint32_t frame = 0; frame < bodies_.frame_count(); ++frame) {
    for (std::size_t body = 0; body < bodies_.size(); ++body) bodies_.place(scene, ids[body], body, frame);
    const auto start = std::chrono::steady_clock::now();
    run.reports.push_back(scene.step());
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    run.step_ms.push_back(elapsed.count());
  }
  return run;
}

const ModeStudy::Reports& ModeStudy::truth(ContactDetail detail) const {
  if (detail == ContactDetail::regions) return regions_;
  return detail == ContactDetail::vertices ? vertices_ : features_;
}

ModeResult ModeStudy::measure(const ModeSetting& setting, std::uint32_t runs) const {
  ModeResult result;
  result.setting = setting;
  std::vector<double> fastest(bodies_.frame_count(), std::numeric_limits<double>::infinity());
  Reports reports;
  for (std::uint32_t i = 0; i < runs; ++i) {
    Run run = this->run(setting.settings);
    for (std::size_t frame = 0; frame < fastest.size(); ++frame)
      fastest[frame] = std::min(fastest[frame], run.step_ms[frame]);
    reports = std::move(run.reports);
  }
  for (const double ms : fastest) {
    result.step_ms += ms / static_cast<double>(fastest.size());
    result.longest_step_ms = std::max(result.longest_step_ms, ms);
  }
  const ContactDetail detail = setting.settings.detail;
  const Reports& truths = truth(detail);
  const Reports& below = detail == ContactDetail::regions ? vertices_ : truths;
  for (std::size_t frame = 0; frame < reports.size(); ++frame)
    compare(*reports[frame], *truths[frame], *below[frame], result);
  return result;
}

void ModeStudy::compare(const FrameReport& report, const FrameReport& truth, const FrameReport& below,
                        ModeResult& result) const {
  const double unit = bodies_.mean_edge_length();
  const std::uint64_t region_pairs = report.statistics().work.region_pairs_tested;
  result.region_pairs += region_pairs;
  result.most_region_pairs = std::max(result.most_region_pairs, region_pairs);
  for (const PairReport& expected : truth.pairs()) {
    const PairReport* row = same_pair(report, expected);
    ++result.pair_rows;
    if (result.setting.settings.detail != ContactDetail::none) result.contacts_true += expected.contact_count;
    result.pairs_true += is_in_contact(expected) ? 1U : 0U;
    if (row == nullptr) continue;
    result.complete_rows += row->complete ? 1U : 0U;
    if (result.setting.settings.detail != ContactDetail::none) {
      const auto contacts = report.contacts(*row);
      result.contacts_reported += contacts.size();
      result.contacts_found += common_count(contacts, truth.contacts(expected));
      result.contacts_below += common_count(contacts, below.contacts(*same_pair(below, expected)));
    }
    if (is_in_contact(expected) && is_in_contact(*row)) ++result.pairs_found;
    result.width.add((row->distance.upper - row->distance.lower) / unit);
    result.above.add((row->distance.upper - expected.distance.upper) / unit);
    result.below.add((expected.distance.lower - row->distance.lower) / unit);
    if (row->distance.lower > expected.distance.lower || row->distance.upper < expected.distance.upper)
      ++result.broken_bounds;
  }
}

}  // namespace graze::tools
