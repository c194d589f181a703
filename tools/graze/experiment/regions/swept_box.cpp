#include "experiment/regions/swept_box.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

namespace graze::tools {

PrincipalFrame::PrincipalFrame(std::span<const Eigen::Vector3d> points) {
  const Eigen::Vector3d& origin = points.front();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d offset = point - origin;
    sum += offset;
    products += offset * offset.transpose();
  }
  const Eigen::Vector3d offset = sum / static_cast<double>(points.size());
  mean = origin + offset;
  const Eigen::Matrix3d spread = products - sum * offset.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  axes[0] = solver.eigenvectors().col(2).normalized();
  if (!(std::abs(axes[0].norm() - 1) < 0.5)) axes[0] = Eigen::Vector3d::UnitX();
  // If the points lie on a line, any second direction will do.
  const Eigen::Vector3d across = axes[0].cross(solver.eigenvectors().col(1));
  axes[2] = across.norm() > 0.5 ? across.normalized() : axes[0].unitOrthogonal();
  axes[1] = axes[2].cross(axes[0]);
  local.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d from_mean = point - mean;
    local.emplace_back(axes[0].dot(from_mean), axes[1].dot(from_mean), axes[2].dot(from_mean));
  }
}

double RadiusLeft::spend_about_middle(std::span<const Eigen::Vector3d> local, Eigen::Index axis) {
  double low = local.front()[axis];
  double high = low;
  for (const Eigen::Vector3d& point : local) {
    low = std::min(low, point[axis]);
    high = std::max(high, point[axis]);
  }
  const double middle = 0.5 * (low + high);
  for (std::size_t i = 0; i < local.size(); ++i)
    squared_[i] += (local[i][axis] - middle) * (local[i][axis] - middle);
  return middle;
}

double RadiusLeft::fix_radius() {
  const double radius_squared = *std::max_element(squared_.begin(), squared_.end());
  for (double& squared : squared_) squared = radius_squared - squared;
  return std::sqrt(radius_squared);
}

RadiusLeft::Side RadiusLeft::spend_beyond_side(std::span<const Eigen::Vector3d> local, Eigen::Index axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < local.size(); ++i) {
    const double may_be_off = std::sqrt(squared_[i]);
    low = std::min(low, local[i][axis] + may_be_off);
    high = std::max(high, local[i][axis] - may_be_off);
  }
  const Side side{0.5 * (low + high), std::max(0.0, 0.5 * (high - low))};
  for (std::size_t i = 0; i < local.size(); ++i) {
    const double beyond = std::max(0.0, std::abs(local[i][axis] - side.middle) - side.half);
    squared_[i] = std::max(0.0, squared_[i] - beyond * beyond);
  }
  return side;
}

}  // namespace graze::tools
