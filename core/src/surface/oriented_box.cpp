#include "core/surface/oriented_box.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace graze {
namespace {

/// More than all rounding of a place along axes, relative to the sum of the lengths that it is made from.
constexpr double rounding = 0x1p-40;

/// A vector square to a unit vector.
Eigen::Vector3d any_square_to(const Eigen::Vector3d& unit) {
  Eigen::Index least = 0;
  unit.cwiseAbs().minCoeff(&least);
  return unit.cross(Eigen::Vector3d::Unit(least));
}

}  // namespace

OrientedBox OrientedBox::of(const Box& box) {
  OrientedBox oriented;
  oriented.origin = box.min;
  oriented.middle = oriented.half = (box.max - box.min) * (0.5 * round_up);
  return oriented;
}

Eigen::Matrix3d axes_through(const std::array<Eigen::Vector3d, 3>& points) {
  const Eigen::Vector3d u = points[1] - points[0];
  const double length = u.norm();
  if (!(length > 0x1p-400)) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d along = u / length;
  const Eigen::Vector3d to_third = points[2] - points[0];
  Eigen::Vector3d beside = to_third - along.dot(to_third) * along;
  const double left = beside.norm();
  const bool is_off_line = left > 0x1p-400 && left > 0x1p-30 * to_third.norm();
  beside = is_off_line ? Eigen::Vector3d(beside / left) : any_square_to(along);
  // Once more, since what is left of a point near the line is rounded a lot.
  beside = (beside - along.dot(beside) * along).normalized();
  Eigen::Matrix3d axes;
  axes << along.transpose(), beside.transpose(), along.cross(beside).transpose();
  return axes;
}

void OrientedExtent::add(const OrientedBox& box) {
  const Eigen::Vector3d at = axes_ * ((box.origin - origin_) + box.axes.transpose() * box.middle);
  const Eigen::Vector3d reach = (axes_ * box.axes.transpose()).cwiseAbs() * box.half;
  low_ = low_.cwiseMin(at - reach);
  high_ = high_.cwiseMax(at + reach);
}

OrientedBox OrientedExtent::box() const {
  const double sizes = low_.lpNorm<1>() + high_.lpNorm<1>();
  OrientedBox box;
  box.axes = axes_;
  box.origin = origin_;
  box.middle = 0.5 * (low_ + high_);
  box.half = (0.5 * (high_ - low_)).array() + (sizes * rounding + lost_to_underflow);
  return box;
}

double lower_along_axes(const OrientedBox& a, const OrientedBox& b) {
  const Eigen::Vector3d way = b.origin - a.origin;
  const Eigen::Vector3d at = a.axes * (way + b.axes.transpose() * b.middle) - a.middle;
  const Eigen::Vector3d reach = a.half + (a.axes * b.axes.transpose()).cwiseAbs() * b.half;
  const double sizes =
      way.lpNorm<1>() + a.middle.lpNorm<1>() + a.half.lpNorm<1>() + b.middle.lpNorm<1>() + b.half.lpNorm<1>();
  const double slack = sizes * rounding + lost_to_underflow;
  const Eigen::Array3d gap = (at.cwiseAbs() - reach).array() - slack;
  return std::max(0.0, gap.max(0.0).matrix().norm() - lost_to_underflow) * (1 - rounding);
}

}  // namespace graze
