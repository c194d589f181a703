#pragma once

#include <compare>
#include <map>
#include <vector>

#include "support/exact/exact_distance.hpp"

namespace graze::oracle {

/// The name of a contact: its kind and its two features. Contacts are sorted by it.
struct Name {
  ContactKind kind;
  Feature a, b;

  friend auto operator<=>(const Name&, const Name&) = default;
};

/// The name of a contact between two features of these dimensions.
Name name_of(Feature a, Feature b);

/// A contact still in exact coordinates.
struct ExactContact {
  Rational distance_squared;
  Point point_a, point_b;
  bool pierced = false;
  bool sunk = false;
};
using ExactContacts = std::map<Name, ExactContact>;

/// The contacts of `features` within the limit, and all piercings. The diagonal of a quad that is not flat,
/// or is flat and folded over, acts like an edge.
ExactContacts collect_features(const ExactShape& a, const ExactShape& b, const Limit& limit,
                               const FacePairs& pairs = {});

Named rounded(const Name& name, const ExactContact& contact);
std::vector<Named> rounded(const ExactContacts& contacts);

}  // namespace graze::oracle
