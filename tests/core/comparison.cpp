#include "core/comparison.hpp"

#include <cmath>
#include <sstream>

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

/// The contract's bound: 2^-48 times the size of the features plus their gap. Here the size is that of both
/// objects' coordinates, which the random scenes keep near that of their features.
double allowed_error(const oracle::Named& expected) {
  const double size =
      std::max(expected.point_a.cwiseAbs().maxCoeff(), expected.point_b.cwiseAbs().maxCoeff());
  return (1 + size + expected.distance) * 0x1p-48;
}

std::string difference_of(const Contact& contact, const oracle::Named& expected) {
  std::ostringstream out;
  out.precision(17);
  const std::string name = name_text(contact.kind, contact.feature_a, contact.feature_b);
  const std::string wanted = name_text(expected.kind, expected.a, expected.b);
  if (name != wanted) return name + " instead of " + wanted + "\n";
  const double error = allowed_error(expected);
  if (!(std::abs(contact.distance - expected.distance) <= error))
    out << name << ": distance " << contact.distance << " instead of " << expected.distance << "\n";
  if (!((contact.point_a - expected.point_a).norm() <= 8 * error))
    out << name << ": point_a " << contact.point_a.transpose() << " instead of "
        << expected.point_a.transpose() << "\n";
  if (!((contact.point_b - expected.point_b).norm() <= 8 * error))
    out << name << ": point_b " << contact.point_b.transpose() << " instead of "
        << expected.point_b.transpose() << "\n";
  if (!(std::abs(contact.normal.norm() - 1) <= 1e-14)) out << name << ": the normal is not of unit length\n";
  const Eigen::Vector3d gap = expected.point_b - expected.point_a;
  if (expected.distance > 1e-6 && !((contact.normal - gap / expected.distance).norm() <= 1e-9))
    out << name << ": normal " << contact.normal.transpose() << " along a gap of " << gap.transpose() << "\n";
  return out.str();
}

}  // namespace

std::shared_ptr<const Mesh> mesh_of(const oracle::Shape& shape) {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> counts;
  for (const auto& face : shape.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    counts.push_back(static_cast<std::uint32_t>(face.size()));
  }
  return std::make_shared<const Mesh>(Mesh::from_polygons(shape.positions, corners, counts));
}

Surface surface_of(const oracle::Shape& rest, const std::vector<Eigen::Vector3d>& now) {
  Surface surface(mesh_of(rest));
  surface.set_positions(now);
  surface.refit_vertices();
  surface.refit_faces();
  return surface;
}

Surface surface_of(const oracle::Shape& shape) {
  return surface_of(shape, shape.positions);
}

PairAnswer detect(const Surface& a, const Surface& b, const PairQuery& query) {
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  detector.detect(a, b, query, answer, counters);
  return answer;
}

std::string difference_of(const std::vector<Contact>& contacts, const std::vector<oracle::Named>& expected) {
  std::string text;
  for (std::size_t i = 0; i < std::min(contacts.size(), expected.size()) && text.empty(); ++i)
    text = difference_of(contacts[i], expected[i]);
  if (contacts.size() != expected.size())
    text +=
        std::to_string(contacts.size()) + " contacts instead of " + std::to_string(expected.size()) + "\n";
  if (!text.empty()) text += "got:\n" + text_of(contacts) + "expected:\n" + text_of(expected);
  return text;
}

std::string difference_of(const PairAnswer& answer, const oracle::Pair& expected) {
  std::ostringstream out;
  out.precision(17);
  if (answer.distance.lower != expected.distance_down || answer.distance.upper != expected.distance_up)
    out << "bounds " << answer.distance.lower << ".." << answer.distance.upper << " instead of "
        << expected.distance_down << ".." << expected.distance_up << "\n";
  const double apart = (answer.witness.point_b - answer.witness.point_a).norm();
  const double size = 1 + answer.witness.point_a.cwiseAbs().maxCoeff();
  if (!(std::abs(apart - expected.distance_up) <= size * 0x1p-47))
    out << "the witness's points are " << apart << " apart, not " << expected.distance_up << "\n";
  return out.str();
}

std::string text_of(const std::vector<Contact>& contacts) {
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
