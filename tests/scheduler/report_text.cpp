#include "scheduler/report_text.hpp"

#include <cmath>
#include <graze/scene_enumerators.hpp>
#include <sstream>
#include <tuple>

namespace graze::tests {
namespace {

void write(std::ostream& out, const Eigen::Vector3d& point) {
  out << " (" << point.x() << " " << point.y() << " " << point.z() << ")";
}

void write(std::ostream& out, const Feature& feature) {
  out << " " << to_string(feature.kind) << feature.index;
}

/// `phase` as a word of the caller's choice.
std::string row_text(const PairReport& pair, std::span<const Contact> contacts, std::string_view phase) {
  std::ostringstream out;
  out << std::hexfloat;
  out << pair.a.index << ":" << pair.a.generation << " " << pair.b.index << ":" << pair.b.generation << " "
      << phase << (pair.complete ? "" : " incomplete") << (pair.contacts_cut ? " cut" : "")
      << (pair.stale ? " stale" : "") << " inside:" << to_string(pair.inside) << " " << pair.distance.lower
      << ".." << pair.distance.upper;
  write(out, pair.witness.feature_a);
  write(out, pair.witness.feature_b);
  write(out, pair.witness.point_a);
  write(out, pair.witness.point_b);
  out << " way out " << pair.way_out.fullness << " " << pair.way_out.thickness << " " << pair.way_out.extent;
  write(out, pair.way_out.direction);
  write(out, pair.way_out.point);
  for (const Contact& contact : contacts) {
    out << "\n  " << to_string(contact.kind) << " " << contact.distance << " " << to_string(contact.side_a)
        << " " << to_string(contact.side_b) << (contact.sunk ? " sunk" : "");
    write(out, contact.feature_a);
    write(out, contact.feature_b);
    write(out, contact.point_a);
    write(out, contact.point_b);
    write(out, contact.normal);
  }
  return out.str();
}

bool in_contact(const PairReport& pair) {
  return pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
}

/// The times and impacts of a pair in words. They are empty if nothing meets or comes near.
std::string sweep_text(const PairReport& pair, std::span<const Impact> impacts) {
  std::ostringstream out;
  out << std::hexfloat;
  if (pair.time_of_impact != 1 || pair.time_of_gap != 1)
    out << "\n  meets at " << pair.time_of_impact << " near at " << pair.time_of_gap;
  for (const Impact& impact : impacts) {
    out << "\n  impact " << to_string(impact.kind) << " " << to_string(impact.status) << " " << impact.lower
        << ".." << impact.upper;
    write(out, impact.feature_a);
    write(out, impact.feature_b);
  }
  return out.str();
}

/// Whether the numbers of a way out go together. What passes through each other is not apart.
bool is_consistent(const WayOut& way, const DistanceBounds& distance) {
  const bool has_direction = way.direction != Eigen::Vector3d::Zero();
  if (!way.point.allFinite() || !(way.fullness >= 0) || !(way.fullness <= 1 + 1e-9)) return false;
  if (has_direction != (way.fullness >= 0.1) || (way.fullness > 0 && distance.lower > 0)) return false;
  if (!has_direction) return way.thickness == 0 && way.extent == 0;
  return std::abs(way.direction.norm() - 1) < 1e-9 && way.thickness >= 0 && way.extent >= 0 &&
         std::isfinite(way.thickness) && std::isfinite(way.extent);
}

bool is_sunk_edge_pair(const Contact& contact) {
  return contact.kind == ContactKind::EE && contact.distance > 0 && contact.side_a == Side::back &&
         contact.side_b == Side::back;
}

std::string problem_of_sweep(const PairReport& pair, std::span<const Impact> impacts) {
  if (!(pair.time_of_impact >= 0 && pair.time_of_impact <= 1 && pair.time_of_gap >= 0 &&
        pair.time_of_gap <= 1))
    return "times of a sweep";
  if (!impacts.empty() && pair.time_of_impact != impacts[0].lower) return "time of impact";
  const auto key = [](const Impact& i) { return std::tie(i.lower, i.kind, i.feature_a, i.feature_b); };
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const Impact& impact = impacts[i];
    if (!(impact.lower >= 0 && impact.lower <= impact.upper && impact.upper <= 1))
      return "bounds of an impact";
    if (impact.kind != ContactKind::VF && impact.kind != ContactKind::EE) return "kind of an impact";
    if (impact.status == ImpactStatus::at_start && impact.upper != 0) return "an impact at the start";
    if (i > 0 && !(key(impacts[i - 1]) < key(impact))) return "order of impacts";
  }
  return {};
}

std::string problem_of(const FrameReport& report, const PairReport& pair) {
  // A surface may have no features that are tested against each other.
  const bool may_be_infinite = pair.a == pair.b && !(in_contact(pair) && pair.complete);
  if (!(pair.distance.lower >= 0) || !(pair.distance.lower <= pair.distance.upper) ||
      !(std::isfinite(pair.distance.upper) || may_be_infinite))
    return "bounds";
  if (!pair.witness.point_a.allFinite() || !pair.witness.point_b.allFinite()) return "witness";
  if (!is_consistent(pair.way_out, pair.distance)) return "way out";
  const auto contacts = report.contacts(pair);
  const bool is_sweep_undone = !pair.complete && pair.time_of_impact == 0 && pair.impact_count == 0;
  if (!contacts.empty() && (!in_contact(pair) || (!pair.complete && !pair.contacts_cut && !is_sweep_undone)))
    return "contacts without being in contact";
  // A limit of contacts cuts impacts, too.
  if (pair.contacts_cut && ((!in_contact(pair) && pair.impact_count == 0) || pair.complete))
    return "cut, but not in contact or complete";
  const std::string problem = problem_of_sweep(pair, report.impacts(pair));
  if (!problem.empty()) return problem;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    if (!std::isfinite(contact.distance) || !contact.point_a.allFinite() || !contact.point_b.allFinite() ||
        !(std::abs(contact.normal.norm() - 1) < 1e-12))
      return "numbers of a contact";
    if (contact.sunk && !is_sunk_edge_pair(contact)) return "what is sunk";
    const auto key = [](const Contact& c) { return std::tie(c.kind, c.feature_a, c.feature_b); };
    if (i > 0 && !(key(contacts[i - 1]) < key(contact))) return "order of contacts";
  }
  return {};
}

}  // namespace

std::string text_of(const FrameReport& report, const PairReport& pair) {
  return text_of(pair, report.contacts(pair)) + sweep_text(pair, report.impacts(pair));
}

std::string text_of(const PairReport& pair, std::span<const Contact> contacts) {
  return row_text(pair, contacts, to_string(pair.phase));
}

std::vector<std::string> rows_of(const FrameReport& report) {
  std::vector<std::string> rows;
  for (const PairReport& pair : report.pairs()) rows.push_back(text_of(report, pair));
  return rows;
}

std::vector<std::string> timeless_rows_of(const FrameReport& report, double range) {
  std::vector<std::string> rows;
  for (const PairReport& pair : report.pairs())
    if (in_contact(pair) || pair.distance.lower < range)
      rows.push_back(row_text(pair, report.contacts(pair), in_contact(pair) ? "contact" : "apart"));
  return rows;
}

std::string difference_of(const FrameReport& left, const FrameReport& right) {
  if (left.frame() != right.frame()) return "frame";
  if (left.complete() != right.complete()) return "complete";
  const auto left_rows = rows_of(left);
  const auto right_rows = rows_of(right);
  if (left_rows.size() != right_rows.size())
    return std::to_string(left_rows.size()) + " rows and " + std::to_string(right_rows.size());
  for (std::size_t i = 0; i < left_rows.size(); ++i)
    if (left_rows[i] != right_rows[i]) return left_rows[i] + "\nand\n" + right_rows[i];
  for (std::size_t i = 0; i < left.contacts().size(); ++i)
    if (left.contacts()[i].since != right.contacts()[i].since) return "since when a contact is there";
  if (left.diagnostics().size() != right.diagnostics().size()) return "number of diagnostics";
  for (std::size_t i = 0; i < left.diagnostics().size(); ++i) {
    const Diagnostic& l = left.diagnostics()[i];
    const Diagnostic& r = right.diagnostics()[i];
    if (l.object != r.object || l.kind != r.kind || l.message != r.message)
      return l.message + "\nand\n" + r.message;
  }
  return {};
}

std::string inconsistency_of(const FrameReport& report) {
  std::size_t next_contact = 0;
  std::size_t impacts = 0;
  bool complete = true;
  for (const PairReport& pair : report.pairs()) {
    if (pair.first_contact != next_contact) return "the rows' contacts do not follow one another";
    next_contact += pair.contact_count;
    if (next_contact > report.contacts().size()) return "a row's contacts are beyond the report's";
    if (pair.impact_count > 0 && pair.first_impact != impacts)
      return "the rows' impacts do not follow one another";
    impacts += pair.impact_count;
    if (impacts > report.impacts().size()) return "a row's impacts are beyond the report's";
    complete = complete && pair.complete;
    const std::string problem = problem_of(report, pair);
    if (!problem.empty()) return problem + ": " + text_of(report, pair);
  }
  if (next_contact != report.contacts().size()) return "contacts of no row";
  if (impacts != report.impacts().size()) return "impacts of no row";
  if (complete != report.complete()) return "complete() is not that of all rows";
  return {};
}

}  // namespace graze::tests
