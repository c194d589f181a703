#pragma once

#include <graze/report.hpp>
#include <span>
#include <string>
#include <vector>

#include "support/oracle.hpp"

namespace graze::tests {

/// The surfaces of a pair of objects, at the positions they have now.
struct ShapePair {
  const oracle::Shape& a;
  const oracle::Shape& b;
};

/// What is wrong with contacts measured against the oracle's: another set, a distance off by more than the
/// contract allows, points or a normal that do not belong to it. Empty where all is well.
std::string difference_of(std::span<const Contact> contacts, const std::vector<oracle::Named>& expected,
                          const ShapePair& shapes);

/// The same for an exact row's distance: the truth rounded down and up, and a witness that realises it.
std::string difference_of(const PairReport& row, const oracle::Pair& expected);

/// C++ that makes the shape, for a failing scene to be pasted into a test.
std::string text_of(const oracle::Shape& shape);

}  // namespace graze::tests
