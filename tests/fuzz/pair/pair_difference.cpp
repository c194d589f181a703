#include <algorithm>
#include <cmath>
#include <graze/error.hpp>
#include <optional>

#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"
#include "pair_case.hpp"
#include "support/comparison.hpp"
#include "support/mesh_of.hpp"

namespace graze::fuzz {
namespace {

using tests::Expected;
using tests::Tolerance;
using tests::TwoShapes;

bool is_meshable(const oracle::Shape& shape) {
  return std::all_of(shape.faces.begin(), shape.faces.end(), [&](const auto& face) {
    return std::all_of(face.begin(), face.end(), [&](std::uint32_t corner) {
      return shape.positions[corner].allFinite() && shape.positions[corner].cwiseAbs().maxCoeff() <= 0x1p120;
    });
  });
}

/// Nothing where the mesh was refused.
std::optional<Surface> surface_of(const oracle::Shape& shape) {
  try {
    Surface surface(tests::mesh_of(shape));
    surface.refit_vertices();
    surface.refit(RefitOf::radii);
    surface.refit_faces();
    surface.make_blocks();
    return surface;
  } catch (const Error&) {
    return std::nullopt;
  }
}

PairAnswer answer_of(const Surface& a, const Surface& b, double threshold, const PairAsk& ask) {
  PairQuery query;
  query.detail = ask.detail;
  query.mode = ask.mode;
  query.threshold = ask.epsilon.empty() ? threshold : ask.epsilon.back();
  query.reach = std::max(query.threshold, ask.reach);
  query.tolerance = ask.tolerance;
  query.epsilon = ask.epsilon;
  query.work_limit = ask.work_limit;
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  detector.detect(a, b, query, answer, counters);
  return answer;
}

/// A double is at most the truth where it is at most the truth rounded down.
std::string bounds_difference(const PairAnswer& answer, const oracle::Pair& truth) {
  if (!(answer.distance.lower <= truth.distance_down)) return "the lower bound is above the distance\n";
  if (!(answer.distance.upper >= truth.distance_up)) return "the upper bound is below the distance\n";
  return "";
}

std::string width_difference(const PairAnswer& answer, double tolerance) {
  const double width = answer.distance.upper - answer.distance.lower;
  const double rounding = 0x1p-50 * answer.distance.upper + 0x1p-530;  // and what underflow may lose
  return width <= tolerance + rounding ? "" : "the bounds are further apart than the tolerance\n";
}

std::string exact_difference(const PairAnswer& answer, const TwoShapes& shapes, const PairAsk& ask) {
  const Expected expected = tests::expected_of(shapes.a, shapes.b, shapes.threshold, ask.detail);
  const Tolerance tolerance(shapes.a, shapes.b);
  if (!answer.complete) {
    if (!answer.contacts.empty()) return "contacts of an answer that is not complete\n";
    return answer.listed ? bounds_difference(answer, expected.distance) : "";
  }
  if (answer.in_contact != expected.in_contact) return "in contact or not is wrong\n";
  const bool is_near =
      expected.in_contact || tests::is_within(expected.distance, std::max(ask.reach, shapes.threshold));
  // Within a tolerance a pair is listed when its lower bound is near enough.
  if (answer.listed != is_near && !(answer.listed && ask.mode == AccuracyMode::within))
    return "listed or not is wrong\n";
  if (!answer.listed) return "";
  std::string difference = tests::difference_of(answer.contacts, expected.contacts, tolerance);
  if (ask.mode == AccuracyMode::exact || expected.in_contact)
    return difference + tests::difference_of(answer.distance, answer.witness, expected.distance, tolerance);
  return difference + bounds_difference(answer, expected.distance) + width_difference(answer, ask.tolerance);
}

/// Bounds that hold, and contacts that are pairs of vertices nearer than the last number.
std::string paper_difference(const PairAnswer& answer, const TwoShapes& shapes, const PairAsk& ask) {
  if (!answer.listed) return "";
  const double threshold = ask.epsilon.empty() ? shapes.threshold : ask.epsilon.back();
  const auto vertices = oracle::vertices(shapes.a, shapes.b, threshold);
  for (const Contact& contact : answer.contacts) {
    const bool is_known = std::any_of(vertices.begin(), vertices.end(), [&](const oracle::Named& named) {
      return named.a == contact.feature_a && named.b == contact.feature_b;
    });
    if (!is_known) return "a contact of vertices that are not near\n";
  }
  return bounds_difference(answer, oracle::vertex_distance(shapes.a, shapes.b));
}

}  // namespace

std::string pair_difference(const TwoShapes& shapes, const PairAsk& ask) {
  const std::optional<Surface> a = surface_of(shapes.a);
  const std::optional<Surface> b = surface_of(shapes.b);
  if (a.has_value() != is_meshable(shapes.a) || b.has_value() != is_meshable(shapes.b))
    return "a mesh is refused or taken that should not be\n";
  if (!a || !b) return "";
  const PairAnswer answer = answer_of(*a, *b, shapes.threshold, ask);
  return ask.mode == AccuracyMode::paper ? paper_difference(answer, shapes, ask)
                                         : exact_difference(answer, shapes, ask);
}

}  // namespace graze::fuzz
