#pragma once

#include <graze/mesh.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/comparison.hpp"
#include "support/mesh_of.hpp"

namespace graze::tests {

/// A surface at the body's present positions, refitted for every detail.
Surface surface_of(const Body& body);

/// An exact query about a pair at any distance.
PairQuery query_of(ContactDetail detail, double threshold);
PairAnswer detect(const Surface& a, const Surface& b, const PairQuery& query);

/// Whether two ways came to the same answer, to the last bit.
void check_same(const PairAnswer& answer, const PairAnswer& other);

/// The result of comparing an answer with the oracle's.
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
/// The detail `nearest`, without solids.
Comparison compare_nearest(const Body& a, const Body& b, double threshold);
/// The details about vertices: vertices, regions.
Comparison compare_vertices(const Body& a, const Body& b, double threshold);

}  // namespace graze::tests
