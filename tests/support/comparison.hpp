#pragma once

#include <array>
#include <cstdint>
#include <graze/contact.hpp>
#include <span>
#include <string>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// The error that the contract allows for a distance: 2^-48 times the size of the two features plus their
/// gap.
class Tolerance {
 public:
  Tolerance(const oracle::Shape& a, const oracle::Shape& b);

  [[nodiscard]] double of(const Feature& a, const Feature& b, double distance) const;

 private:
  struct Side {
    const oracle::Shape& shape;
    std::vector<std::array<std::uint32_t, 2>> edges;
  };
  static double size_of(const Side& side, const Feature& feature);

  Side a_;
  Side b_;
};

/// The answer of brute force for a pair in exact mode.
struct Expected {
  std::vector<oracle::Named> contacts;
  oracle::Pair distance;
  bool in_contact = false;
};
Expected expected_of(const oracle::Shape& a, const oracle::Shape& b, double threshold, ContactDetail detail,
                     const oracle::Shape& rest_a, const oracle::Shape& rest_b,
                     const oracle::FacePairs& pairs = {});
/// Returns the answer of brute force for a pair of shapes at rest.
Expected expected_of(const oracle::Shape& a, const oracle::Shape& b, double threshold, ContactDetail detail);

/// Whether a pair is strictly closer than `reach`, decided exactly.
bool is_within(const oracle::Pair& distance, double reach);

/// Describes how contacts differ from the oracle's. Empty if they do not. They differ if the set is another,
/// or if a value is off by more than the contract allows.
std::string difference_of(std::span<const Contact> contacts, const std::vector<oracle::Named>& expected,
                          const Tolerance& tolerance);

/// Describes how the bounds and the witness of a pair in exact mode differ from the oracle's. Empty if they
/// do not. The bounds must be the true distance rounded down and up, and the witness must realise it.
std::string difference_of(const DistanceBounds& distance, const Witness& witness,
                          const oracle::Pair& expected, const Tolerance& tolerance);

/// `ContactKind` names and features of all, a line each.
std::string text_of(std::span<const Contact> contacts);
std::string text_of(const std::vector<oracle::Named>& contacts);
/// C++ that makes the shape, for a failing scene to be pasted into a test.
std::string text_of(const oracle::Shape& shape);

}  // namespace graze::tests
