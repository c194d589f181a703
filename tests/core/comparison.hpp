#pragma once

#include <graze/mesh.hpp>
#include <graze/pair_query.hpp>
#include <graze/surface.hpp>
#include <optional>
#include <string>
#include <vector>

#include "support/oracle.hpp"

namespace graze::tests {

std::shared_ptr<const Mesh> mesh_of(const oracle::Shape& shape);

/// A surface at the shape's positions, refitted for every detail.
Surface surface_of(const oracle::Shape& shape);

/// The same topology moved: `rest` gives the mesh, `now` the positions.
Surface surface_of(const oracle::Shape& rest, const std::vector<Eigen::Vector3d>& now);

PairAnswer detect(const Surface& a, const Surface& b, const PairQuery& query);

/// What is wrong with contacts measured against the oracle's: another set, or a value off by more than the
/// contract allows. Empty where all is well.
std::string difference_of(const std::vector<Contact>& contacts, const std::vector<oracle::Named>& expected);

/// The same for a pair in exact mode: the bounds are the truth rounded down and up, and the witness realises
/// it.
std::string difference_of(const PairAnswer& answer, const oracle::Pair& expected);

/// `ContactKind` names and features of all, a line each.
std::string text_of(const std::vector<Contact>& contacts);
std::string text_of(const std::vector<oracle::Named>& contacts);
/// C++ that makes the shape, for a failing scene to be pasted into a test.
std::string text_of(const oracle::Shape& shape);

}  // namespace graze::tests
