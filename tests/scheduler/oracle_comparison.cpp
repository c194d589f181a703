#include "scheduler/oracle_comparison.hpp"

#include <cmath>
#include <sstream>

namespace graze::tests {
namespace {

std::string name_text(ContactKind kind, const Feature& a, const Feature& b) {
  std::string text(to_string(kind));
  for (const Feature& feature : {a, b})
    text.append(" ").append(to_string(feature.kind)).append(std::to_string(feature.index));
  return text;
}

std::vector<std::uint32_t> vertices_of(const oracle::Shape& shape, const Feature& feature) {
  if (feature.kind == FeatureKind::vertex) return {feature.index};
  if (feature.kind == FeatureKind::face) return shape.faces[feature.index];
  const auto edge = oracle::edges_of(shape)[feature.index];
  return {edge[0], edge[1]};
}

/// The diagonal of a feature's box.
double size_of(const oracle::Shape& shape, const Feature& feature) {
  const auto vertices = vertices_of(shape, feature);
  Eigen::Vector3d min = shape.positions[vertices[0]];
  Eigen::Vector3d max = min;
  for (const std::uint32_t vertex : vertices) {
    min = min.cwiseMin(shape.positions[vertex]);
    max = max.cwiseMax(shape.positions[vertex]);
  }
  return (max - min).norm();
}

std::string difference_of(const Contact& contact, const oracle::Named& expected, const ShapePair& shapes) {
  const std::string name = name_text(contact.kind, contact.feature_a, contact.feature_b);
  const std::string wanted = name_text(expected.kind, expected.a, expected.b);
  if (name != wanted) return name + " instead of " + wanted + "\n";
  const double allowed =
      (size_of(shapes.a, expected.a) + size_of(shapes.b, expected.b) + expected.distance) * 0x1p-48;
  // Points are coordinates: they round by their own size too.
  const double point_allowed = 8 * allowed + 0x1p-50 * (1 + expected.point_a.norm());
  const Eigen::Vector3d gap = expected.point_b - expected.point_a;
  std::ostringstream out;
  out.precision(17);
  if (!(std::abs(contact.distance - expected.distance) <= allowed))
    out << name << ": distance " << contact.distance << " instead of " << expected.distance << "\n";
  if (!((contact.point_a - expected.point_a).norm() <= point_allowed))
    out << name << ": point_a " << contact.point_a.transpose() << " instead of "
        << expected.point_a.transpose() << "\n";
  if (!((contact.point_b - expected.point_b).norm() <= point_allowed))
    out << name << ": point_b " << contact.point_b.transpose() << " instead of "
        << expected.point_b.transpose() << "\n";
  if (!(std::abs(contact.normal.norm() - 1) <= 1e-14)) out << name << ": the normal is not of unit length\n";
  if (expected.distance > 1e-6 && !((contact.normal - gap / expected.distance).norm() <= 1e-9))
    out << name << ": normal " << contact.normal.transpose() << " along a gap of " << gap.transpose() << "\n";
  return out.str();
}

}  // namespace

std::string difference_of(std::span<const Contact> contacts, const std::vector<oracle::Named>& expected,
                          const ShapePair& shapes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(contacts.size(), expected.size()) && text.empty(); ++i)
    text = difference_of(contacts[i], expected[i], shapes);
  if (contacts.size() != expected.size())
    text +=
        std::to_string(contacts.size()) + " contacts instead of " + std::to_string(expected.size()) + "\n";
  return text;
}

std::string difference_of(const PairReport& row, const oracle::Pair& expected) {
  std::ostringstream out;
  out.precision(17);
  if (row.distance.lower != expected.distance_down || row.distance.upper != expected.distance_up)
    out << "bounds " << row.distance.lower << ".." << row.distance.upper << " instead of "
        << expected.distance_down << ".." << expected.distance_up << "\n";
  const double apart = (row.witness.point_b - row.witness.point_a).norm();
  const double size = 1 + row.witness.point_a.cwiseAbs().maxCoeff();
  if (!(std::abs(apart - expected.distance_up) <= size * 0x1p-47))
    out << "the witness's points are " << apart << " apart, not " << expected.distance_up << "\n";
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
