#pragma once

#include "support/oracle/oracle_features.hpp"

namespace graze::oracle {

/// The parallel candidates of `closest` at exactly this distance, whose closest points fill a stretch or an
/// area: EE, EF and FF, each with the middle of that set.
ExactContacts collect_parallel(const ExactShape& a, const ExactShape& b, const Rational& distance_squared,
                               const FacePairs& pairs = {});

}  // namespace graze::oracle
