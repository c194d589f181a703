#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace graze {

/// Whether a type says that it holds another type of number. Types that convert numbers when they are made,
/// such as Eigen's and glm's vectors, say so.
template <typename Tuple, typename Number>
concept NamesOtherNumber = requires {
  requires !std::same_as<typename Tuple::Scalar, Number>;
}
|| requires {
  requires !std::same_as<typename Tuple::value_type, Number>;
};

/// Whether braces around `count` numbers make a Tuple without a narrowing conversion. So integers make no
/// tuple of floats, nor floats one of integers.
template <typename Tuple, typename Number, std::size_t count>
concept BracedFrom = (count == 3 &&
                      requires(const Number n) {
                        Tuple{n, n, n};
                      }) ||
                     (count == 4 && requires(const Number n) {
                       Tuple{n, n, n, n};
                     });

/// A type whose memory is `count` numbers one after the other and nothing else. Eigen's small vectors,
/// std::array and a caller's own struct with `count` members are such types.
template <typename Tuple, typename Number, std::size_t count>
concept TupleOf = sizeof(Tuple) == count * sizeof(Number) &&
                  alignof(Tuple) >= alignof(Number) && BracedFrom<Tuple, Number, count> &&
                  !NamesOtherNumber<Tuple, Number>;

/// An integer of 32 bits, with a sign or without.
template <typename Integer>
concept Index32 = std::same_as<Integer, std::uint32_t> || std::same_as<Integer, std::int32_t>;

/// The corners of one face: `count` integers of 32 bits.
template <typename Face, std::size_t count>
concept CornerTuple = TupleOf<Face, std::uint32_t, count> || TupleOf<Face, std::int32_t, count>;

}  // namespace graze
