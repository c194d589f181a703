#pragma once

#include <functional>

#include "support/oracle/oracle_edges.hpp"
#include "support/oracle/oracle_features.hpp"

namespace graze::oracle {

/// The closest point of a whole surface to a point, or none if the surface is not within the limit. Exact
/// ties go to the lowest feature. `extent` is the box of the point.
std::optional<Foot> foot_on_surface(const Point& point, const Extent& extent, const ExactShape& shape,
                                    const Limit& limit);

/// Says of a used vertex whether its contact is listed at any distance.
using ListedAnyway = std::function<bool(std::uint32_t vertex)>;

/// The contacts of `nearest` within the limit, all piercings, and the contacts of the vertices of each shape
/// that are listed anyway. A fold makes a contact only where nothing else is within the limit or pierces.
ExactContacts collect_nearest(const ExactShape& a, const ExactShape& b, const Limit& limit,
                              const Creases& creases, const ListedAnyway& listed_of_a,
                              const ListedAnyway& listed_of_b);

}  // namespace graze::oracle
