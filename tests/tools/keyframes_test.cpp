#include <cmath>
#include <graze/io/keyframes.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "support/catch.hpp"

namespace {

using Eigen::Vector3d;
using graze::io::KeyPose;
using graze::io::Placement;
using graze::io::pose_at;
using graze::io::rotation_from_degrees;

/// A point turned about one fixed axis, by the plane formula.
Vector3d turned(const Vector3d& point, int axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Vector3d result = point;
  result[u] = std::cos(angle) * point[u] - std::sin(angle) * point[v];
  result[v] = std::sin(angle) * point[u] + std::cos(angle) * point[v];
  return result;
}

}  // namespace

TEST_CASE("a rotation turns about x, then y, then z, all fixed") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> degrees(-400, 400);
  for (int round = 0; round < 200; ++round) {
    const Vector3d angles{degrees(random), degrees(random), degrees(random)};
    const Vector3d point(0.3, -1.2, 2.5);
    const Vector3d expected = turned(turned(turned(point, 0, angles.x()), 1, angles.y()), 2, angles.z());
    CHECK((rotation_from_degrees(angles) * point - expected).norm() < 1e-13);
  }
}

TEST_CASE("quarter turns are exact") {
  const Vector3d x = rotation_from_degrees({0, 0, 90}) * Vector3d(1, 2, 3);
  CHECK(x == Vector3d(-2, 1, 3));
  CHECK(rotation_from_degrees({180, 0, 0}) * Vector3d(1, 2, 3) == Vector3d(1, -2, -3));
  CHECK(rotation_from_degrees({0, -450, 0}) * Vector3d(1, 2, 3) == Vector3d(-3, 2, 1));
}

TEST_CASE("a placement scales, turns and moves, in this order") {
  const Placement placement{{10, 20, 30}, rotation_from_degrees({0, 0, 90}), 2 * Eigen::Matrix3d::Identity()};
  CHECK(placement.apply({1, 0, 0}) == Vector3d(10, 22, 30));
  CHECK_FALSE(placement.is_identity());
  CHECK(Placement{}.is_identity());
}

TEST_CASE("poses are held outside their keys, exact at them, and interpolated between") {
  const std::vector<KeyPose> keys = {{10, {1, 0, 0}, rotation_from_degrees({0, 0, 0})},
                                     {20, {3, 0, 4}, rotation_from_degrees({0, 0, 80})},
                                     {30, {3, 0, 4}, rotation_from_degrees({0, 0, 80})}};
  CHECK(pose_at(keys, 0).matrix() == pose_at(keys, 10).matrix());
  CHECK(pose_at(keys, 10).translation() == Vector3d(1, 0, 0));
  CHECK(pose_at(keys, 1000).matrix() == pose_at(keys, 30).matrix());
  CHECK(pose_at(keys, 25).matrix() == pose_at(keys, 20).matrix());
  for (std::uint32_t frame = 10; frame <= 20; ++frame) {
    const double part = (frame - 10) / 10.0;
    const auto pose = pose_at(keys, frame);
    CHECK((pose.translation() - Vector3d(1 + 2 * part, 0, 4 * part)).norm() < 1e-15);
    CHECK((pose.linear() * Vector3d(1, 1, 1) - turned({1, 1, 1}, 2, 80 * part)).norm() < 1e-14);
  }
}

TEST_CASE("a rotation between keys takes the shorter way and stays a rotation") {
  const std::vector<KeyPose> keys = {{0, {0, 0, 0}, rotation_from_degrees({0, 0, 170})},
                                     {4, {0, 0, 0}, rotation_from_degrees({0, 0, -170})}};
  CHECK((pose_at(keys, 2).linear() * Vector3d(1, 0, 0) - Vector3d(-1, 0, 0)).norm() < 1e-14);
  const std::vector<KeyPose> general = {{0, {0, 0, 0}, rotation_from_degrees({31, -77, 12})},
                                        {7, {0, 0, 0}, rotation_from_degrees({-120, 15, 66})}};
  for (std::uint32_t frame = 0; frame <= 7; ++frame) {
    const Eigen::Matrix3d rotation = pose_at(general, frame).linear();
    CHECK((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(rotation.determinant() > 0);
  }
}
