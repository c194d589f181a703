#pragma once

#include <array>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/pair_query.hpp>
#include <graze/surface.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/shapes.hpp"
#include "support/oracle.hpp"

namespace graze::tests {

std::shared_ptr<const Mesh> mesh_of(const oracle::Shape& shape);

/// A surface at the body's present positions, refitted for every detail.
Surface surface_of(const Body& body);

/// An exact query about a pair at any distance.
PairQuery query_of(ContactDetail detail, double threshold);
PairAnswer detect(const Surface& a, const Surface& b, const PairQuery& query);

/// What the contract allows a distance to be off: 2^-48 times the size of the two features plus their gap.
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

/// What is wrong with contacts measured against the oracle's: another set, or a value off by more than the
/// contract allows. Empty where all is well.
std::string difference_of(const std::vector<Contact>& contacts, const std::vector<oracle::Named>& expected,
                          const Tolerance& tolerance);

/// The same for a pair in exact mode: the bounds are the truth rounded down and up, and the witness realises
/// it.
std::string difference_of(const PairAnswer& answer, const oracle::Pair& expected, const Tolerance& tolerance);

/// What came of comparing an answer with the oracle's.
struct Comparison {
  std::string difference;    ///< empty where all is well
  std::size_t contacts = 0;  ///< compared

  void add(const Comparison& other) {
    difference += other.difference;
    contacts += other.contacts;
  }
};

/// Every detail against brute force: set, values, bounds and witness.
Comparison compare(const Body& a, const Body& b, double threshold);
/// The details about surfaces: features, closest, none.
Comparison compare_surfaces(const Body& a, const Body& b, double threshold);
/// The details about vertices: vertices, regions.
Comparison compare_vertices(const Body& a, const Body& b, double threshold);

/// `ContactKind` names and features of all, a line each.
std::string text_of(const std::vector<Contact>& contacts);
std::string text_of(const std::vector<oracle::Named>& contacts);
/// C++ that makes the shape, for a failing scene to be pasted into a test.
std::string text_of(const oracle::Shape& shape);

}  // namespace graze::tests
