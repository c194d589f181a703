#include "support/edge_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace graze::tests {
namespace {

std::string text_of(const oracle::EdgePair& pair) {
  std::ostringstream out;
  out << "e" << pair.a.index << " e" << pair.b.index << " at "
      << oracle::round_sqrt(pair.contact.a.distance_squared);
  if (pair.is_locally_closest) out << ", locally closest";
  if (pair.lies_flat) out << ", flat";
  if (pair.bounds_patch) out << ", bounds a patch";
  if (pair.is_sunk) out << ", sunk";
  return out.str() + "\n";
}

std::string text_of(Side side) {
  static constexpr const char* names[] = {"none", "front", "back"};
  return names[static_cast<std::size_t>(side)];
}

/// How one contact differs from the pair of the same edges.
std::string difference_of(const Contact& contact, const oracle::EdgePair& pair, const Tolerance& tolerance) {
  std::ostringstream out;
  const auto compare_sides = [&](const char* which, Side got, Side wanted) {
    if (got != wanted) out << which << " is " << text_of(got) << " instead of " << text_of(wanted) << "\n";
  };
  compare_sides("side_a", contact.side_a, pair.side_a);
  compare_sides("side_b", contact.side_b, pair.side_b);
  if (contact.sunk != pair.is_sunk) out << (pair.is_sunk ? "not sunk\n" : "sunk\n");
  const double distance = oracle::round_sqrt(pair.contact.a.distance_squared);
  const double separation = pair.is_sunk ? -distance : distance;
  const double error = tolerance.of(pair.a, pair.b, distance);
  if (!(std::abs(contact.separation() - separation) <= error))
    out << "separation " << contact.separation() << " instead of " << separation << "\n";
  const Eigen::Vector3d gap = oracle::round((pair.is_sunk ? oracle::Rational(-1) : oracle::Rational(1)) *
                                            (pair.contact.b.point - pair.contact.a.point));
  if (distance > 0x1p20 * error && !((contact.push() - gap.stableNormalized()).norm() <= 0x1p-20))
    out << "push " << contact.push().transpose() << " along " << gap.transpose() << "\n";
  return out.str();
}

}  // namespace

std::vector<oracle::EdgePair> edge_pairs_of(const oracle::Shape& a, const oracle::Shape& b, double threshold,
                                            const oracle::Creases& creases, const oracle::FacePairs& pairs) {
  const oracle::ExactShape exact_a(a);
  const oracle::ExactShape exact_b(b);
  return oracle::EdgeOracle(exact_a, exact_b, pairs).pairs_within(oracle::Limit::below(threshold), creases);
}

std::string edge_difference(ContactDetail detail, std::span<const Contact> contacts,
                            const std::vector<oracle::EdgePair>& expected, const Tolerance& tolerance) {
  std::string text;
  auto contact = contacts.begin();
  const auto skip_to_edges = [&] {
    contact =
        std::find_if(contact, contacts.end(), [](const Contact& c) { return c.kind == ContactKind::EE; });
  };
  skip_to_edges();
  for (const oracle::EdgePair& pair : expected) {
    const bool is_found =
        contact != contacts.end() && contact->feature_a == pair.a && contact->feature_b == pair.b;
    const bool is_wanted = detail != ContactDetail::nearest || pair.is_listed();
    if (is_found != is_wanted) {
      text += (is_found ? "listed: " : "missing: ") + text_of(pair);
    } else if (is_found) {
      const std::string difference = difference_of(*contact, pair, tolerance);
      if (!difference.empty()) text += text_of(pair) + difference;
    }
    if (!is_found) continue;
    ++contact;
    skip_to_edges();
  }
  if (contact != contacts.end()) text += "no such pair:\n" + tests::text_of(std::span(&*contact, 1));
  return text;
}

void EdgeTally::count(const std::vector<oracle::EdgePair>& pairs) {
  for (const oracle::EdgePair& pair : pairs) {
    const auto add = [](std::size_t& counter, bool holds) { counter += holds ? 1U : 0U; };
    const bool is_behind = pair.side_a == Side::back && pair.side_b == Side::back;
    ++judged;
    add(locally_closest, pair.is_locally_closest);
    add(patches_only, pair.bounds_patch && !pair.is_locally_closest);
    add(sunk, pair.is_sunk);
    add(sunk_and_listed, pair.is_sunk && pair.is_listed());
    add(behind_only, is_behind && !pair.is_sunk);
    add(flat, pair.is_locally_closest && pair.lies_flat);
    add(crossing, pair.contact.a.distance_squared == 0);
    add(left_out, !pair.is_listed());
  }
}

void EdgeTally::print(const char* what) const {
  std::cout << what << ": judged " << judged << " pairs of edges, " << locally_closest << " locally closest, "
            << patches_only << " listed since they bound a patch, " << left_out << " left out, " << sunk
            << " sunk, of which " << sunk_and_listed << " listed, " << behind_only
            << " behind each other without piercing, " << crossing << " crossing, " << flat << " flat\n";
}

}  // namespace graze::tests
