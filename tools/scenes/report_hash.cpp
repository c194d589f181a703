#include "scenes/report_hash.hpp"

#include <bit>

namespace graze::scenes {
namespace {

template <typename Enumeration>
std::uint64_t number_of(Enumeration value) {
  return static_cast<std::uint64_t>(value);
}

}  // namespace

void ReportHash::add(double number) {
  add(std::bit_cast<std::uint64_t>(number));
}

void ReportHash::add(const Eigen::Vector3d& point) {
  for (int axis = 0; axis < 3; ++axis) add(point[axis]);
}

void ReportHash::add(const Feature& feature) {
  add(number_of(feature.kind) << 32U | feature.index);
}

void ReportHash::add(ObjectId id) {
  add(std::uint64_t{id.generation} << 32U | id.index);
}

void ReportHash::add_distance(const PairReport& pair) {
  add(pair.distance.lower);
  add(pair.distance.upper);
  add(pair.witness.feature_a);
  add(pair.witness.feature_b);
  add(pair.witness.point_a);
  add(pair.witness.point_b);
}

void ReportHash::add(const WayOut& way) {
  add(way.direction);
  add(way.point);
  add(way.fullness);
  add(way.thickness);
  add(way.extent);
}

void ReportHash::add(const Impact& impact) {
  add(number_of(impact.kind) << 8U | number_of(impact.status));
  add(impact.feature_a);
  add(impact.feature_b);
  add(impact.lower);
  add(impact.upper);
}

void ReportHash::add(const PairReport& pair) {
  add(pair.a);
  add(pair.b);
  add(number_of(pair.phase) << 2U | (pair.complete ? 2U : 0U) | (pair.stale ? 1U : 0U));
  add_distance(pair);
  add(std::uint64_t{pair.contact_count});
  // Rows without solids, limits and sweeps have the hashes that they had before there were any.
  if (pair.inside != Inside::none) add(number_of(pair.inside));
  if (pair.contacts_cut) add(std::uint64_t{1});
  if (pair.way_out.fullness != 0) add(pair.way_out);
  if (pair.impact_count > 0 || pair.time_of_impact != 1 || pair.time_of_gap != 1) {
    add(pair.time_of_impact);
    add(pair.time_of_gap);
    add(std::uint64_t{pair.impact_count});
  }
}

void ReportHash::add(const Contact& contact) {
  add(number_of(contact.kind) << 16U | number_of(contact.side_a) << 8U | number_of(contact.side_b));
  if (contact.sunk) add(std::uint64_t{1});
  add(contact.feature_a);
  add(contact.feature_b);
  add(contact.point_a);
  add(contact.point_b);
  add(contact.normal);
  add(contact.distance);
}

void ReportHash::add(const FrameReport& report) {
  add(report.frame());
  add(std::uint64_t{report.complete() ? 1U : 0U});
  for (const PairReport& pair : report.pairs()) add(pair);
  for (const Contact& contact : report.contacts()) {
    add(contact);
    add(report.age(contact));
  }
  for (const Impact& impact : report.impacts()) add(impact);
  for (const Diagnostic& diagnostic : report.diagnostics()) {
    add(diagnostic.object);
    add(number_of(diagnostic.kind));
  }
}

}  // namespace graze::scenes
