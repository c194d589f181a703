#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

// Lanes stand for the vector types of GCC and clang where a compiler has none (kernels/vectors.hpp). They
// have the same operations in each lane, with the same results bit for bit.

namespace graze {

template <typename Number, std::size_t count>
struct Lanes;

/// Comparisons give integers of the numbers' size: all bits of a lane where it holds, or none.
template <typename Number>
using LaneBits = std::conditional_t<sizeof(Number) == 8, std::int64_t, std::int32_t>;

/// `result(i)` in each lane i.
template <typename Number, std::size_t count, typename Result>
constexpr Lanes<Number, count> in_lanes(const Result& result) {
  Lanes<Number, count> lanes{};
  for (std::size_t i = 0; i < count; ++i) lanes[i] = static_cast<Number>(result(i));
  return lanes;
}

/// Numbers side by side. Where one side of an operator is a single number, it stands for all lanes.
template <typename Number, std::size_t count>
struct Lanes {
  using Bits = Lanes<LaneBits<Number>, count>;

  Number lane[count];

  constexpr Number& operator[](std::size_t i) { return lane[i]; }
  constexpr const Number& operator[](std::size_t i) const { return lane[i]; }

  constexpr Lanes operator-() const {
    return in_lanes<Number, count>([&](std::size_t i) { return -lane[i]; });
  }
  constexpr Lanes operator~() const {
    return in_lanes<Number, count>([&](std::size_t i) { return ~lane[i]; });
  }
  static constexpr Lanes all(Number number) {
    return in_lanes<Number, count>([&](std::size_t) { return number; });
  }

#define GRAZE_OPERATOR(op)                                                       \
  friend constexpr Lanes operator op(const Lanes& a, const Lanes& b) {           \
    return in_lanes<Number, count>([&](std::size_t i) { return a[i] op b[i]; }); \
  }                                                                              \
  friend constexpr Lanes operator op(const Lanes& a, Number b) {                 \
    return a op all(b);                                                          \
  }                                                                              \
  friend constexpr Lanes operator op(Number a, const Lanes& b) {                 \
    return all(a) op b;                                                          \
  }                                                                              \
  constexpr Lanes& operator op##=(const Lanes& b) {                              \
    return *this = *this op b;                                                   \
  }                                                                              \
  constexpr Lanes& operator op##=(Number b) {                                    \
    return *this = *this op b;                                                   \
  }
  GRAZE_OPERATOR(+)
  GRAZE_OPERATOR(-)
  GRAZE_OPERATOR(*)
  GRAZE_OPERATOR(&)
  GRAZE_OPERATOR(|)
  GRAZE_OPERATOR(^)
#undef GRAZE_OPERATOR

#define GRAZE_COMPARISON(op)                                                                        \
  friend constexpr Bits operator op(const Lanes& a, const Lanes& b) {                               \
    return in_lanes<LaneBits<Number>, count>([&](std::size_t i) { return a[i] op b[i] ? -1 : 0; }); \
  }                                                                                                 \
  friend constexpr Bits operator op(const Lanes& a, Number b) {                                     \
    return a op all(b);                                                                             \
  }
  GRAZE_COMPARISON(<)
  GRAZE_COMPARISON(>)
  GRAZE_COMPARISON(<=)
  GRAZE_COMPARISON(>=)
  GRAZE_COMPARISON(!=)
#undef GRAZE_COMPARISON
};

/// The lanes of `first` where the condition holds, and otherwise those of `second`.
template <typename Condition, typename Number, std::size_t count>
constexpr Lanes<Number, count> pick_lanes(const Lanes<Condition, count>& condition,
                                          const Lanes<Number, count>& first,
                                          const Lanes<Number, count>& second) {
  return in_lanes<Number, count>([&](std::size_t i) { return condition[i] != 0 ? first[i] : second[i]; });
}
template <typename Number>
constexpr Number pick_lanes(bool condition, Number first, Number second) {
  return condition ? first : second;
}

/// The lanes with these numbers: those of `first`, and behind them those of `second`.
template <std::size_t... numbers, typename Number, std::size_t count>
constexpr Lanes<Number, sizeof...(numbers)> shuffle_lanes(const Lanes<Number, count>& first,
                                                          const Lanes<Number, count>& second) {
  return {{(numbers < count ? first[numbers % count] : second[numbers % count])...}};
}

/// Each lane as a number of the type that `To` has.
template <typename To, typename Number, std::size_t count>
constexpr To convert_lanes(const Lanes<Number, count>& lanes) {
  return in_lanes<std::remove_cvref_t<decltype(To{}[0])>, count>([&](std::size_t i) { return lanes[i]; });
}

}  // namespace graze
