#pragma once

#include <Eigen/Core>

namespace graze::tests {

/// The number type that results in double are compared with.
using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

}  // namespace graze::tests
