#include "core/comparison.hpp"

#include <limits>

#include "core/pair/pair_counters.hpp"
#include "core/search/pair_detector.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

std::string difference_of(const char* what, const PairAnswer& answer,
                          const std::vector<oracle::Named>& expected, bool in_contact,
                          const oracle::Pair& distance, const Tolerance& tolerance) {
  std::string text = difference_of(answer.contacts, expected, tolerance);
  text += difference_of(answer.distance, answer.witness, distance, tolerance);
  if (answer.in_contact != in_contact) text += "in contact or not is wrong\n";
  return text.empty() ? text : std::string(what) + ": " + text;
}

}  // namespace

Surface surface_of(const Body& body) {
  Surface surface(mesh_of(body.rest));
  surface.set_positions(body.now.positions);
  surface.refit_vertices();
  surface.refit(RefitOf::radii);
  surface.refit_faces();
  surface.make_blocks();
  return surface;
}

PairQuery query_of(ContactDetail detail, double threshold) {
  PairQuery query;
  query.detail = detail;
  query.threshold = threshold;
  query.reach = std::numeric_limits<double>::infinity();
  return query;
}

PairAnswer detect(const Surface& a, const Surface& b, const PairQuery& query) {
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  detector.detect(a, b, query, answer, counters);
  return answer;
}

Comparison compare(const Body& a, const Body& b, double threshold) {
  Comparison comparison = compare_surfaces(a, b, threshold);
  comparison.add(compare_vertices(a, b, threshold));
  return comparison;
}

Comparison compare_surfaces(const Body& a, const Body& b, double threshold) {
  const Surface surface_a = surface_of(a);
  const Surface surface_b = surface_of(b);
  const Tolerance tolerance(a.now, b.now);
  const oracle::Pair distance = oracle::surface_distance(a.now, b.now);
  const auto features = oracle::features(a.now, b.now, threshold);
  const auto closest = oracle::closest(a.now, b.now, threshold);
  Comparison comparison{{}, features.size() + (closest ? 1 : 0)};
  const auto check = [&](ContactDetail detail, const char* what, const std::vector<oracle::Named>& expected) {
    const PairAnswer answer = detect(surface_a, surface_b, query_of(detail, threshold));
    comparison.difference += difference_of(what, answer, expected, closest.has_value(), distance, tolerance);
  };
  check(ContactDetail::features, "features", features);
  check(ContactDetail::closest, "closest", closest ? std::vector{*closest} : std::vector<oracle::Named>{});
  check(ContactDetail::none, "none", {});
  return comparison;
}

Comparison compare_nearest(const Body& a, const Body& b, double threshold) {
  const Expected expected = expected_of(a.now, b.now, threshold, ContactDetail::nearest);
  const PairAnswer answer = detect(surface_of(a), surface_of(b), query_of(ContactDetail::nearest, threshold));
  return {difference_of("nearest", answer, expected.contacts, expected.in_contact, expected.distance,
                        {a.now, b.now}),
          expected.contacts.size()};
}

Comparison compare_vertices(const Body& a, const Body& b, double threshold) {
  const Surface surface_a = surface_of(a);
  const Surface surface_b = surface_of(b);
  const Tolerance tolerance(a.now, b.now);
  const oracle::Pair distance = oracle::vertex_distance(a.now, b.now);
  const auto vertices = oracle::vertices(a.now, b.now, threshold);
  const auto regions = oracle::regions(a.now, b.now, threshold, a.rest, b.rest);
  Comparison comparison{{}, vertices.size() + regions.size()};
  const auto check = [&](ContactDetail detail, const char* what, const std::vector<oracle::Named>& expected) {
    const PairAnswer answer = detect(surface_a, surface_b, query_of(detail, threshold));
    comparison.difference += difference_of(what, answer, expected, !expected.empty(), distance, tolerance);
  };
  check(ContactDetail::vertices, "vertices", vertices);
  check(ContactDetail::regions, "regions", regions);
  return comparison;
}

void check_same(const PairAnswer& answer, const PairAnswer& other) {
  CHECK(answer.complete == other.complete);
  CHECK(answer.in_contact == other.in_contact);
  REQUIRE(answer.listed == other.listed);
  if (!answer.listed) return;
  CHECK(answer.distance.lower == other.distance.lower);
  CHECK(answer.distance.upper == other.distance.upper);
  CHECK(answer.witness.feature_a == other.witness.feature_a);
  CHECK(answer.witness.feature_b == other.witness.feature_b);
  CHECK(text_of(answer.contacts) == text_of(other.contacts));
}

}  // namespace graze::tests
