#include "accuracy/contact_error.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace graze::tools {
namespace {

using oracle::ExactContact;
using oracle::ExactShape;
using oracle::Point;
using oracle::Rational;

double as_double(const Rational& value) {
  return oracle::round(value);
}

double length(const Point& vector) {
  return oracle::round_sqrt(squared_length(vector));
}

double largest_coordinate(const Point& point) {
  return oracle::round(point).cwiseAbs().maxCoeff();
}

/// |√p - √q|, by way of p - q so that it does not cancel.
double difference_of_roots(const Rational& p, const Rational& q) {
  const double sum = oracle::round_sqrt(p) + oracle::round_sqrt(q);
  return sum == 0 ? 0 : std::abs(as_double(p - q)) / sum;
}

/// How many units an error is. An error of 0 is 0 units, whatever the unit.
double in_units(double error, double unit) {
  return error == 0 ? 0 : error / unit;
}

/// The angle between two vectors, up to π.
double angle(const Point& u, const Point& v) {
  const Rational lengths = squared_length(u) * squared_length(v);
  const double sine = oracle::round_sqrt(squared_length(cross(u, v)) / lengths);
  return std::atan2(sine, as_double(dot(u, v)) / oracle::round_sqrt(lengths));
}

/// The directions that the normal may have, exactly, where they follow from the positions by one formula.
/// That is along the gap. At distance 0 it is a's face normal, else minus b's, else across both edges. Empty
/// where normals are averaged.
std::vector<Point> directions(const Contact& contact, const ExactContact& truth, const ExactShape& a,
                              const ExactShape& b) {
  if (truth.distance_squared != 0) return {truth.point_b - truth.point_a};
  std::vector<Point> found;
  const auto add = [&found](const Point& direction) {
    if (!is_zero(direction)) found.push_back(direction);
  };
  const bool may_be_on_fold = !truth.pierced;
  const auto add_face = [&](const ExactShape& shape, std::uint32_t face, int sign) {
    const auto& triangles = shape.faces[face].triangles;
    const bool is_smooth =
        triangles.size() == 1 || (is_zero(cross(triangles[0].normal, triangles[1].normal)) &&
                                  dot(triangles[0].normal, triangles[1].normal) > 0);
    if (may_be_on_fold && !is_smooth) return;  // the normalised sum of two normals
    for (const oracle::Triangle& triangle : triangles) add(Rational(sign) * triangle.normal);
  };
  if (contact.feature_a.kind == FeatureKind::face) {
    add_face(a, contact.feature_a.index, 1);
  } else if (contact.feature_b.kind == FeatureKind::face) {
    add_face(b, contact.feature_b.index, -1);
  } else if (contact.kind == ContactKind::EE) {
    const auto along = [](const ExactShape& shape, std::uint32_t edge) {
      const auto& ends = shape.segments[edge].ends;
      return shape.points[ends[1]] - shape.points[ends[0]];
    };
    const Point across = cross(along(a, contact.feature_a.index), along(b, contact.feature_b.index));
    add(across);
    add(Rational(-1) * across);
  }
  return found;
}

}  // namespace

ContactMeter::ContactMeter(const oracle::Shape& a, const oracle::Shape& b) : a_(a), b_(b), tolerance_(a, b) {}

void ContactMeter::add(const Contact& contact, const ExactContact& truth, KernelErrors& errors) const {
  const double distance = oracle::round_sqrt(truth.distance_squared);
  const double unit = tolerance_.of(contact.feature_a, contact.feature_b, distance) / distance_bound;
  const Rational reported(contact.distance);
  const double error = difference_of_roots(reported * reported, truth.distance_squared);
  ++errors.contacts;
  errors.distance.add(in_units(error, unit));
  errors.distance_absolute.add(error);
  if (distance > 0) errors.distance_relative.add(error / distance);
  double largest = 0;
  const auto add_point = [&](const Eigen::Vector3d& point, const Point& true_point) {
    const double coordinate = largest_coordinate(true_point) * 0x1p-53;
    largest = std::max(largest, coordinate);
    errors.point.add(in_units(length(oracle::exact(point) - true_point), unit + coordinate));
  };
  add_point(contact.point_a, truth.point_a);
  add_point(contact.point_b, truth.point_b);
  const Point between = oracle::exact(contact.point_b) - oracle::exact(contact.point_a);
  errors.apart.add(
      in_units(difference_of_roots(squared_length(between), truth.distance_squared), unit + largest));
  add_normal(contact, truth, errors);
}

void ContactMeter::add_normal(const Contact& contact, const ExactContact& truth, KernelErrors& errors) const {
  errors.normal_length.add(difference_of_roots(squared_length(oracle::exact(contact.normal)), 1));
  double smallest = std::numeric_limits<double>::infinity();
  for (const Point& direction : directions(contact, truth, a_, b_))
    smallest = std::min(smallest, angle(oracle::exact(contact.normal), direction));
  if (std::isfinite(smallest)) errors.normal_angle.add(smallest);
}

}  // namespace graze::tools
