#include "rows.hpp"

#include <algorithm>
#include <tuple>

#include "report/report_builder.hpp"

namespace graze {

// The fields of what a row has, in the order in which they travel.

template <Is<Feature> T>
auto fields(T& r) {
  return std::tie(r.kind, r.index);
}
template <Is<Contact> T>
auto fields(T& r) {
  return std::tie(r.kind, r.side_a, r.side_b, r.sunk, r.feature_a, r.feature_b, r.point_a.x(), r.point_a.y(),
                  r.point_a.z(), r.point_b.x(), r.point_b.y(), r.point_b.z(), r.normal.x(), r.normal.y(),
                  r.normal.z(), r.distance, r.since);
}
template <Is<Impact> T>
auto fields(T& r) {
  return std::tie(r.kind, r.feature_a, r.feature_b, r.lower, r.upper, r.status);
}
template <Is<DistanceBounds> T>
auto fields(T& r) {
  return std::tie(r.lower, r.upper);
}
template <Is<Witness> T>
auto fields(T& r) {
  return std::tie(r.feature_a, r.feature_b, r.point_a.x(), r.point_a.y(), r.point_a.z(), r.point_b.x(),
                  r.point_b.y(), r.point_b.z());
}
template <Is<WayOut> T>
auto fields(T& r) {
  return std::tie(r.direction.x(), r.direction.y(), r.direction.z(), r.point.x(), r.point.y(), r.point.z(),
                  r.fullness, r.thickness, r.extent);
}
template <Is<PairReport> T>
auto fields(T& r) {
  return std::tie(r.a, r.b, r.user_data_a, r.user_data_b, r.phase, r.complete, r.stale, r.contacts_cut,
                  r.inside, r.distance, r.witness, r.way_out, r.time_of_impact, r.time_of_gap);
}

}  // namespace graze

namespace graze::cluster {
namespace {

/// The fields above must name all that a row has, but for its places in a report.
template <typename Row, std::size_t bytes>
inline constexpr bool has_size = sizeof(Row) == bytes;
static_assert(has_size<Feature, 8> && has_size<Contact, 112> && has_size<Impact, 48> &&
                  has_size<Witness, 64> && has_size<WayOut, 72> && has_size<DistanceBounds, 16> &&
                  has_size<PairReport, 256>,
              "a member was added: add it to the fields");

}  // namespace

ClusterRow row_of(const FrameReport& report, const PairReport& pair, ObjectId a, ObjectId b) {
  ClusterRow row{pair, {}, {}};
  row.pair.a = a;
  row.pair.b = b;
  const auto contacts = report.contacts(pair);
  row.contacts.assign(contacts.begin(), contacts.end());
  const auto impacts = report.impacts(pair);
  row.impacts.assign(impacts.begin(), impacts.end());
  return row;
}

void write_row(ByteBuffer& buffer, const ClusterRow& row) {
  write_fields(buffer, row.pair, row.contacts, row.impacts);
}

ClusterRow read_row(ByteSource& source) {
  ClusterRow row;
  source(row.pair, row.contacts, row.impacts);
  return row;
}

void read_rows(std::span<const std::byte> bytes, std::vector<ClusterRow>& rows) {
  ByteSource source(bytes);
  while (source.at() < bytes.size()) rows.push_back(read_row(source));
}

void sort_rows(std::vector<ClusterRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const ClusterRow& left, const ClusterRow& right) {
    return std::pair(left.a(), left.b()) < std::pair(right.a(), right.b());
  });
}

std::unique_ptr<FrameReport> report_of(std::span<const ClusterRow> rows, std::uint64_t frame,
                                       std::uint64_t tag) {
  auto report = std::make_unique<FrameReport>();
  ReportBuilder builder(*report);
  builder.begin(frame, tag);
  StepStatistics& statistics = builder.statistics();
  for (const ClusterRow& row : rows) {
    PairReport pair = row.pair;
    builder.add_impacts(pair, row.impacts);
    builder.add(pair, row.contacts.size(), {});
    ++statistics.pairs_near;
    if (pair.phase == PairPhase::began || pair.phase == PairPhase::touching) ++statistics.pairs_in_contact;
    if (pair.contacts_cut) ++statistics.pairs_cut;
    statistics.contacts += row.contacts.size();
    statistics.impacts += row.impacts.size();
  }
  auto to = builder.contacts().begin();
  for (const ClusterRow& row : rows) to = std::copy(row.contacts.begin(), row.contacts.end(), to);
  return report;
}

}  // namespace graze::cluster
