#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/quaternion.h>
#include <assimp/vector3.h>

#include <Eigen/Geometry>

namespace graze::io {

inline Eigen::Vector3d to_eigen(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Eigen::Quaterniond to_eigen(const aiQuaternion& q) {
  return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
          static_cast<double>(q.z)};
}

inline Eigen::Affine3d to_eigen(const aiMatrix4x4& m) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (unsigned row = 0; row < 3; ++row)
    for (unsigned column = 0; column < 4; ++column)
      transform(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          static_cast<double>(m[row][column]);
  return transform;
}

}  // namespace graze::io
