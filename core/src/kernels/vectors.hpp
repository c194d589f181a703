#pragma once

// Vectors of numbers, as types of GCC and clang that live in registers, or as plain arrays (lanes.hpp) for
// other compilers. These are macros: kernels may call no function that other translation units share.
//
// GRAZE_VECTOR(Name, Number, count) declares a type. GRAZE_PICK takes the lanes of the second where the first
// holds, and otherwise those of the third. GRAZE_SHUFFLE puts lanes of two vectors together by their numbers,
// GRAZE_CONVERT rounds each lane to another type, and GRAZE_BITS takes the bits as another type.

#include "core/base/compiler.hpp"

#if GRAZE_EXTENSIONS

// NOLINTNEXTLINE(bugprone-macro-parentheses): a type stands in none
#define GRAZE_VECTOR(name, number, count) using name [[gnu::vector_size((count) * sizeof(number))]] = number
#define GRAZE_PICK(condition, first, second) ((condition) ? (first) : (second))
#define GRAZE_SHUFFLE(first, second, ...) __builtin_shufflevector(first, second, __VA_ARGS__)
#define GRAZE_CONVERT(type, vector) __builtin_convertvector(vector, type)
#define GRAZE_BITS(type, vector) reinterpret_cast<type>(vector)
#define GRAZE_RESTRICT __restrict
#define GRAZE_UNROLL_EIGHT _Pragma("GCC unroll 8")
#define GRAZE_LOWEST_BIT(bits) __builtin_ctz(bits)
#define GRAZE_LOWEST_BIT_OF_64(bits) __builtin_ctzll(bits)
#define GRAZE_COUNT_BITS(bits) __builtin_popcount(bits)

#else

#include <bit>

#include "base/lanes.hpp"

#define GRAZE_VECTOR(name, number, count) using name = Lanes<number, count>
#define GRAZE_PICK(condition, first, second) pick_lanes(condition, first, second)
#define GRAZE_SHUFFLE(first, second, ...) shuffle_lanes<__VA_ARGS__>(first, second)
#define GRAZE_CONVERT(type, vector) convert_lanes<type>(vector)
#define GRAZE_BITS(type, vector) std::bit_cast<type>(vector)
#define GRAZE_RESTRICT
#define GRAZE_UNROLL_EIGHT
#define GRAZE_LOWEST_BIT(bits) std::countr_zero(bits)
#define GRAZE_LOWEST_BIT_OF_64(bits) std::countr_zero(bits)
#define GRAZE_COUNT_BITS(bits) std::popcount(bits)

#endif
