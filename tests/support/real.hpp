#pragma once

#include <Eigen/Core>

namespace graze::tests {

/// What the rounding of double is compared with.
using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

}  // namespace graze::tests
