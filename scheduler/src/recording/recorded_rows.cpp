#include "recording/recorded_rows.hpp"

#include <bit>
#include <concepts>
#include <type_traits>

namespace graze {
namespace {

/// A hash of a sequence of numbers. Each number goes through a bijection of 64 bits, so that no two sequences
/// of one length that differ in one number have one hash.
class Hash {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  template <typename Value>
  requires(std::integral<Value> || std::is_enum_v<Value>) void add(Value value) {
    // The constants are those of the generator SplitMix64.
    std::uint64_t bits = (state_ ^ static_cast<std::uint64_t>(value)) + 0x9E3779B97F4A7C15U;
    bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27) * 0x94D049BB133111EBU;
    state_ = bits ^ bits >> 31;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Eigen::Vector3d& point) { (*this)(point.x(), point.y(), point.z()); }
  void add(const Feature& feature) { (*this)(feature.kind, feature.index); }

  std::uint64_t state_ = 0;
};

std::uint64_t answer_hash_of(const FrameReport& report, const PairReport& pair) {
  Hash hash;
  hash(pair.complete, pair.stale, pair.contacts_cut, pair.inside, pair.distance.lower, pair.distance.upper);
  hash(pair.witness.feature_a, pair.witness.feature_b, pair.witness.point_a, pair.witness.point_b);
  hash(pair.way_out.direction, pair.way_out.point, pair.way_out.fullness, pair.way_out.thickness,
       pair.way_out.extent);
  for (const Contact& contact : report.contacts(pair)) {
    hash(contact.kind, contact.side_a, contact.side_b, contact.sunk, contact.feature_a, contact.feature_b);
    hash(contact.point_a, contact.point_b, contact.normal, contact.distance);
  }
  for (const RegionDistance& region : report.region_distances(pair)) {
    hash(region.level, region.region_a, region.region_b, region.vertex_a, region.vertex_b);
    hash(region.point_a, region.point_b, region.distance);
  }
  return hash.value();
}

/// Whether something met on the way, or may have.
bool is_of_sweep(const PairReport& pair) {
  return pair.impact_count > 0 || pair.time_of_impact < 1 || pair.time_of_gap < 1;
}

std::uint64_t history_hash_of(const FrameReport& report, const PairReport& pair) {
  Hash hash;
  hash(pair.phase);
  if (is_of_sweep(pair)) hash(pair.time_of_impact, pair.time_of_gap);
  for (const Impact& impact : report.impacts(pair))
    hash(impact.kind, impact.feature_a, impact.feature_b, impact.lower, impact.upper, impact.status);
  for (const Contact& contact : report.contacts(pair)) hash(report.age(contact));
  return hash.value();
}

std::uint64_t diagnostics_hash_of(const FrameReport& report) {
  Hash hash;
  for (const Diagnostic& diagnostic : report.diagnostics()) hash(diagnostic.kind);
  return hash.value();
}

}  // namespace

void summarize(const FrameReport& report, RecordedReport& recorded) {
  recorded.frame = report.frame();
  recorded.tag = report.tag();
  recorded.complete = report.complete();
  recorded.step_ms = report.statistics().times.step_ms;
  recorded.pairs = report.pairs().size();
  recorded.pairs_in_contact = 0;
  recorded.contacts = report.contacts().size();
  recorded.diagnostics = report.diagnostics().size();
  recorded.diagnostics_hash = diagnostics_hash_of(report);
  recorded.rows.clear();
  recorded.rows.reserve(report.pairs().size());
  for (const PairReport& pair : report.pairs()) {
    if (pair.phase == PairPhase::began || pair.phase == PairPhase::touching) ++recorded.pairs_in_contact;
    recorded.rows.push_back({pair.a, pair.b, pair.phase, pair.complete, pair.stale, pair.contacts_cut,
                             pair.distance.lower, pair.distance.upper, pair.contact_count,
                             answer_hash_of(report, pair), history_hash_of(report, pair), is_of_sweep(pair)});
  }
}

std::uint64_t hash_of(const RecordedReport& report) {
  Hash hash;
  hash(report.complete, report.diagnostics, report.diagnostics_hash);
  for (const RecordedRow& row : report.rows) {
    hash(row.a.index, row.a.generation, row.b.index, row.b.generation);
    hash(row.answer_hash, row.history_hash);
  }
  return hash.value();
}

}  // namespace graze
