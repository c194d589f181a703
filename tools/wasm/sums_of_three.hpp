#pragma once

// For platforms where Eigen has no vector registers. It is included before each source, so that all of a
// program has it.

#if __cplusplus > 201703L

#include <Eigen/Core>
#include <type_traits>

namespace Eigen::internal {

/// Sums of three doubles, such as dot products. Eigen adds them in this order where it has vector registers,
/// as on all platforms that were tried but WebAssembly. Its order without them would give other last bits
/// (docs/platforms.md).
template <typename Function, typename Evaluator>
requires std::is_same_v<typename Evaluator::Scalar, double>
struct redux_novec_unroller<Function, Evaluator, 0, 3> {
  static double run(const Evaluator& values, const Function& add) {
    const auto at = [&values](Index i) {
      return values.coeffByOuterInner(i / Evaluator::InnerSizeAtCompileTime,
                                      i % Evaluator::InnerSizeAtCompileTime);
    };
    return add(add(at(0), at(1)), at(2));
  }
};

}  // namespace Eigen::internal

#endif
