#include "support/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "support/oracle/oracle_grouped_nearest.hpp"

namespace graze::tests {
namespace {

template <typename Name>
std::string name_text(ContactKind kind, const Name& a, const Name& b) {
  static constexpr const char* kinds[] = {"VV", "VE", "VF", "EE", "EF", "FF"};
  static constexpr const char* features[] = {"v", "e", "f"};
  std::string text = kinds[static_cast<std::size_t>(kind)];
  for (const Feature& feature : {a, b}) {
    text.append(" ").append(features[static_cast<std::size_t>(feature.kind)]);
    text.append(std::to_string(feature.index));
  }
  return text;
}

/// Half the distance of neighbouring doubles near a point: what writing it down costs.
double rounding_at(const Eigen::Vector3d& point) {
  return point.cwiseAbs().maxCoeff() * 0x1p-53 + std::numeric_limits<double>::denorm_min();
}

double length(const Eigen::Vector3d& vector) {
  return std::hypot(vector.x(), vector.y(), vector.z());
}

std::string difference_of(const Contact& contact, const oracle::Named& expected, const Tolerance& tolerance) {
  std::ostringstream out;
  out.precision(17);
  const std::string name = name_text(contact.kind, contact.feature_a, contact.feature_b);
  const std::string wanted = name_text(expected.kind, expected.a, expected.b);
  if (name != wanted) return name + " instead of " + wanted + "\n";
  const double error = tolerance.of(expected.a, expected.b, expected.distance);
  if (!(std::abs(contact.distance - expected.distance) <= error))
    out << name << ": distance " << contact.distance << " instead of " << expected.distance << "\n";
  const auto check_point = [&](const char* which, const Eigen::Vector3d& point,
                               const Eigen::Vector3d& truth) {
    if (!(length(point - truth) <= 8 * error + 4 * rounding_at(truth)))
      out << name << ": " << which << " " << point.transpose() << " instead of " << truth.transpose() << "\n";
  };
  check_point("point_a", contact.point_a, expected.point_a);
  check_point("point_b", contact.point_b, expected.point_b);
  if (contact.sunk != expected.sunk) out << name << (expected.sunk ? ": not sunk\n" : ": sunk\n");
  if (!(std::abs(contact.normal.norm() - 1) <= 1e-14)) out << name << ": the normal is not of unit length\n";
  const Eigen::Vector3d gap = expected.point_b - expected.point_a;
  const double blur = rounding_at(expected.point_a) + rounding_at(expected.point_b) + error;
  if (expected.distance > 0x1p20 * blur &&
      !((contact.normal - gap.stableNormalized()).norm() <= 0x1p-20 + 4 * blur / expected.distance))
    out << name << ": normal " << contact.normal.transpose() << " along a gap of " << gap.transpose() << "\n";
  return out.str();
}

bool are_all_faces_looked_at(const oracle::Shape& a, const oracle::Shape& b, const oracle::FacePairs& pairs) {
  for (std::uint32_t face_a = 0; face_a < a.faces.size(); ++face_a)
    for (std::uint32_t face_b = 0; face_b < b.faces.size(); ++face_b)
      if (!pairs.may({FeatureKind::face, face_a}, {FeatureKind::face, face_b})) return false;
  return true;
}

}  // namespace

Expected expected_of(const oracle::Shape& a, const oracle::Shape& b, double threshold, ContactDetail detail,
                     const oracle::Shape& rest_a, const oracle::Shape& rest_b,
                     const oracle::FacePairs& pairs) {
  const bool about_vertices = detail == ContactDetail::vertices || detail == ContactDetail::regions;
  Expected expected;
  expected.distance =
      about_vertices ? oracle::vertex_distance(a, b, pairs) : oracle::surface_distance(a, b, pairs);
  if (detail == ContactDetail::features) expected.contacts = oracle::features(a, b, threshold, pairs);
  if (detail == ContactDetail::vertices) expected.contacts = oracle::vertices(a, b, threshold, pairs);
  if (detail == ContactDetail::regions)
    expected.contacts = oracle::regions(a, b, threshold, rest_a, rest_b, pairs);
  if (detail == ContactDetail::closest)
    if (const auto closest = oracle::closest(a, b, threshold, pairs)) expected.contacts = {*closest};
  if (detail == ContactDetail::nearest)
    expected.contacts = are_all_faces_looked_at(a, b, pairs)
                            ? oracle::nearest(a, b, threshold, rest_a, rest_b)
                            : oracle::nearest(a, b, threshold, rest_a, rest_b, pairs);
  expected.in_contact = !expected.contacts.empty();
  if (detail == ContactDetail::none)
    expected.in_contact = expected.distance.pierced || is_within(expected.distance, threshold);
  return expected;
}

Expected expected_of(const oracle::Shape& a, const oracle::Shape& b, double threshold, ContactDetail detail) {
  return expected_of(a, b, threshold, detail, a, b);
}

bool is_within(const oracle::Pair& distance, double reach) {
  if (reach == std::numeric_limits<double>::infinity()) return true;
  const mpq_class exact(reach);
  return distance.distance_squared < exact * exact;
}

Tolerance::Tolerance(const oracle::Shape& a, const oracle::Shape& b)
    : a_{a, oracle::edges_of(a)}, b_{b, oracle::edges_of(b)} {}

double Tolerance::of(const Feature& a, const Feature& b, double distance) const {
  return (size_of(a_, a) + size_of(b_, b) + distance) * 0x1p-48 + std::numeric_limits<double>::denorm_min();
}

double Tolerance::size_of(const Side& side, const Feature& feature) {
  const auto& positions = side.shape.positions;
  if (feature.kind == FeatureKind::vertex) return 0;
  if (feature.kind == FeatureKind::edge) {
    const auto [low, high] = side.edges[feature.index];
    return length(positions[high] - positions[low]);
  }
  double size = 0;
  for (const std::uint32_t i : side.shape.faces[feature.index])
    for (const std::uint32_t j : side.shape.faces[feature.index])
      size = std::max(size, length(positions[i] - positions[j]));
  return size;
}

std::string difference_of(std::span<const Contact> contacts, const std::vector<oracle::Named>& expected,
                          const Tolerance& tolerance) {
  std::string text;
  for (std::size_t i = 0; i < std::min(contacts.size(), expected.size()) && text.empty(); ++i)
    text = difference_of(contacts[i], expected[i], tolerance);
  if (contacts.size() != expected.size())
    text +=
        std::to_string(contacts.size()) + " contacts instead of " + std::to_string(expected.size()) + "\n";
  if (!text.empty()) text += "got:\n" + text_of(contacts) + "expected:\n" + text_of(expected);
  return text;
}

std::string difference_of(const DistanceBounds& distance, const Witness& witness,
                          const oracle::Pair& expected, const Tolerance& tolerance) {
  std::ostringstream out;
  out.precision(17);
  if (distance.lower != expected.distance_down || distance.upper != expected.distance_up)
    out << "bounds " << distance.lower << ".." << distance.upper << " instead of " << expected.distance_down
        << ".." << expected.distance_up << "\n";
  const double apart = length(witness.point_b - witness.point_a);
  const double error = 8 * tolerance.of(witness.feature_a, witness.feature_b, expected.distance_up) +
                       4 * (rounding_at(witness.point_a) + rounding_at(witness.point_b));
  if (!(std::abs(apart - expected.distance_up) <= error))
    out << "the witness's points are " << apart << " apart, not " << expected.distance_up << "\n";
  return out.str();
}

std::string text_of(std::span<const Contact> contacts) {
  std::ostringstream out;
  out.precision(17);
  for (const Contact& contact : contacts)
    out << "  " << name_text(contact.kind, contact.feature_a, contact.feature_b) << " at " << contact.distance
        << "\n";
  return out.str();
}

std::string text_of(const std::vector<oracle::Named>& contacts) {
  std::ostringstream out;
  out.precision(17);
  for (const oracle::Named& contact : contacts)
    out << "  " << name_text(contact.kind, contact.a, contact.b) << " at " << contact.distance << "\n";
  return out.str();
}

std::string text_of(const oracle::Shape& shape) {
  std::ostringstream out;
  out << std::hexfloat << "Shape{{";
  for (const Eigen::Vector3d& p : shape.positions)
    out << "{" << p.x() << ", " << p.y() << ", " << p.z() << "}, ";
  out << "}, {";
  for (const auto& face : shape.faces) {
    out << "{";
    for (const std::uint32_t corner : face) out << corner << ", ";
    out << "}, ";
  }
  out << "}}\n";
  return out.str();
}

}  // namespace graze::tests
