#pragma once

#include <cstdint>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <string>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "support/reduce.hpp"

namespace graze::fuzz {

/// How a pair is asked about, beside its threshold.
struct PairAsk {
  ContactDetail detail = ContactDetail::features;
  AccuracyMode mode = AccuracyMode::exact;
  double reach = 0;  ///< where it is above the threshold
  double tolerance = 0;
  std::vector<double> epsilon = {};
  std::uint64_t work_limit = ~std::uint64_t{0};
};

struct PairCase {
  tests::TwoShapes shapes;
  PairAsk ask;
};

/// The case that the bytes mean: shapes of up to 24 vertices and 12 faces, degenerate ones and NaN included,
/// on a coarse grid, on a fine one, or of any doubles.
PairCase read_pair_case(ByteReader reader);

/// Bytes that mean these shapes, asked about with this detail in exact mode.
std::string pair_case_bytes(const tests::TwoShapes& shapes, ContactDetail detail);

/// Describes how the library's answer about these shapes differs from brute force in exact arithmetic. Empty
/// if it does not. Shapes that no mesh takes must be refused.
std::string pair_difference(const tests::TwoShapes& shapes, const PairAsk& ask);

/// A word for each setting of `ask`, to stand before a case that is pasted into a test.
std::string text_of(const PairAsk& ask);

}  // namespace graze::fuzz
