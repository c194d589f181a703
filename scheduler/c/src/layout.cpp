#include "layout.hpp"

#include <cstdint>

// Compares the layouts. A member that C++ gets stops the build at the size, and one that moves at its place.

namespace graze::c {
namespace {

/// Whether a member of C is the member of C++. Both are the same number, or a byte and its enumeration, or
/// arrays of the same numbers, or structs that are the same as a whole.
template <typename InC, typename InCpp>
constexpr bool is_same_member() {
  if constexpr (std::is_enum_v<InCpp>)
    return std::is_same_v<InC, std::underlying_type_t<InCpp>>;
  else if constexpr (std::is_class_v<InC>)
    return std::is_same_v<typename SameAs<InC>::type, InCpp>;
  else if constexpr (std::is_array_v<InC>)
    return sizeof(InC) == sizeof(InCpp) &&
           std::is_same_v<std::remove_extent_t<InC>, typename InCpp::value_type>;
  else
    return std::is_same_v<InC, InCpp>;
}

// NOLINTBEGIN(cppcoreguidelines-macro-usage, bugprone-macro-parentheses): members have no other names
#define GRAZE_SAME_MEMBER(row, member)                                         \
  static_assert(offsetof(row, member) == offsetof(SameAs<row>::type, member)); \
  static_assert(is_same_member<decltype(row::member), decltype(SameAs<row>::type::member)>())
#define GRAZE_SAME_SIZE(row)                                 \
  static_assert(sizeof(row) == sizeof(SameAs<row>::type));   \
  static_assert(alignof(row) == alignof(SameAs<row>::type)); \
  static_assert(std::is_standard_layout_v<SameAs<row>::type>)
// NOLINTEND(cppcoreguidelines-macro-usage, bugprone-macro-parentheses)

static_assert(sizeof(bool) == 1);

GRAZE_SAME_SIZE(graze_id);
GRAZE_SAME_MEMBER(graze_id, index);
GRAZE_SAME_MEMBER(graze_id, generation);

GRAZE_SAME_SIZE(graze_feature);
GRAZE_SAME_MEMBER(graze_feature, kind);
GRAZE_SAME_MEMBER(graze_feature, index);

GRAZE_SAME_SIZE(graze_contact);
GRAZE_SAME_MEMBER(graze_contact, kind);
GRAZE_SAME_MEMBER(graze_contact, side_a);
GRAZE_SAME_MEMBER(graze_contact, side_b);
GRAZE_SAME_MEMBER(graze_contact, sunk);
GRAZE_SAME_MEMBER(graze_contact, feature_a);
GRAZE_SAME_MEMBER(graze_contact, feature_b);
GRAZE_SAME_MEMBER(graze_contact, point_a);
GRAZE_SAME_MEMBER(graze_contact, point_b);
GRAZE_SAME_MEMBER(graze_contact, normal);
GRAZE_SAME_MEMBER(graze_contact, distance);
GRAZE_SAME_MEMBER(graze_contact, since);

GRAZE_SAME_SIZE(graze_bounds);
GRAZE_SAME_MEMBER(graze_bounds, lower);
GRAZE_SAME_MEMBER(graze_bounds, upper);

GRAZE_SAME_SIZE(graze_witness);
GRAZE_SAME_MEMBER(graze_witness, feature_a);
GRAZE_SAME_MEMBER(graze_witness, feature_b);
GRAZE_SAME_MEMBER(graze_witness, point_a);
GRAZE_SAME_MEMBER(graze_witness, point_b);

GRAZE_SAME_SIZE(graze_way_out);
GRAZE_SAME_MEMBER(graze_way_out, direction);
GRAZE_SAME_MEMBER(graze_way_out, point);
GRAZE_SAME_MEMBER(graze_way_out, fullness);
GRAZE_SAME_MEMBER(graze_way_out, thickness);
GRAZE_SAME_MEMBER(graze_way_out, extent);

GRAZE_SAME_SIZE(graze_pair);
GRAZE_SAME_MEMBER(graze_pair, a);
GRAZE_SAME_MEMBER(graze_pair, b);
GRAZE_SAME_MEMBER(graze_pair, user_data_a);
GRAZE_SAME_MEMBER(graze_pair, user_data_b);
GRAZE_SAME_MEMBER(graze_pair, phase);
GRAZE_SAME_MEMBER(graze_pair, complete);
GRAZE_SAME_MEMBER(graze_pair, stale);
GRAZE_SAME_MEMBER(graze_pair, contacts_cut);
GRAZE_SAME_MEMBER(graze_pair, inside);
GRAZE_SAME_MEMBER(graze_pair, distance);
GRAZE_SAME_MEMBER(graze_pair, witness);
GRAZE_SAME_MEMBER(graze_pair, first_contact);
GRAZE_SAME_MEMBER(graze_pair, contact_count);
GRAZE_SAME_MEMBER(graze_pair, first_region_distance);
GRAZE_SAME_MEMBER(graze_pair, region_distance_count);
GRAZE_SAME_MEMBER(graze_pair, way_out);
GRAZE_SAME_MEMBER(graze_pair, time_of_impact);
GRAZE_SAME_MEMBER(graze_pair, time_of_gap);
GRAZE_SAME_MEMBER(graze_pair, first_impact);
GRAZE_SAME_MEMBER(graze_pair, impact_count);

GRAZE_SAME_SIZE(graze_region_distance);
GRAZE_SAME_MEMBER(graze_region_distance, level);
GRAZE_SAME_MEMBER(graze_region_distance, region_a);
GRAZE_SAME_MEMBER(graze_region_distance, region_b);
GRAZE_SAME_MEMBER(graze_region_distance, vertex_a);
GRAZE_SAME_MEMBER(graze_region_distance, vertex_b);
GRAZE_SAME_MEMBER(graze_region_distance, point_a);
GRAZE_SAME_MEMBER(graze_region_distance, point_b);
GRAZE_SAME_MEMBER(graze_region_distance, distance);

GRAZE_SAME_SIZE(graze_impact);
GRAZE_SAME_MEMBER(graze_impact, kind);
GRAZE_SAME_MEMBER(graze_impact, feature_a);
GRAZE_SAME_MEMBER(graze_impact, feature_b);
GRAZE_SAME_MEMBER(graze_impact, lower);
GRAZE_SAME_MEMBER(graze_impact, upper);
GRAZE_SAME_MEMBER(graze_impact, status);

GRAZE_SAME_SIZE(graze_contact_geometry);
GRAZE_SAME_MEMBER(graze_contact_geometry, point_a);
GRAZE_SAME_MEMBER(graze_contact_geometry, point_b);
GRAZE_SAME_MEMBER(graze_contact_geometry, normal);
GRAZE_SAME_MEMBER(graze_contact_geometry, push);
GRAZE_SAME_MEMBER(graze_contact_geometry, distance);
GRAZE_SAME_MEMBER(graze_contact_geometry, separation);
GRAZE_SAME_MEMBER(graze_contact_geometry, side_a);
GRAZE_SAME_MEMBER(graze_contact_geometry, side_b);
GRAZE_SAME_MEMBER(graze_contact_geometry, sunk);
GRAZE_SAME_MEMBER(graze_contact_geometry, is_interior);

GRAZE_SAME_SIZE(graze_followed_contact);
GRAZE_SAME_MEMBER(graze_followed_contact, feature_a);
GRAZE_SAME_MEMBER(graze_followed_contact, feature_b);
GRAZE_SAME_MEMBER(graze_followed_contact, geometry);
GRAZE_SAME_MEMBER(graze_followed_contact, is_known);
GRAZE_SAME_MEMBER(graze_followed_contact, steps);

GRAZE_SAME_SIZE(graze_weights);
GRAZE_SAME_MEMBER(graze_weights, count);
GRAZE_SAME_MEMBER(graze_weights, vertex);
GRAZE_SAME_MEMBER(graze_weights, weight);

GRAZE_SAME_SIZE(graze_patch_pair);
GRAZE_SAME_MEMBER(graze_patch_pair, a);
GRAZE_SAME_MEMBER(graze_patch_pair, b);
GRAZE_SAME_MEMBER(graze_patch_pair, inside);
GRAZE_SAME_MEMBER(graze_patch_pair, first_contact);
GRAZE_SAME_MEMBER(graze_patch_pair, contact_count);

GRAZE_SAME_SIZE(graze_patch_answer);
GRAZE_SAME_MEMBER(graze_patch_answer, complete);
GRAZE_SAME_MEMBER(graze_patch_answer, threshold);
GRAZE_SAME_MEMBER(graze_patch_answer, validity);

GRAZE_SAME_SIZE(graze_query_filter);
GRAZE_SAME_MEMBER(graze_query_filter, layer);
GRAZE_SAME_MEMBER(graze_query_filter, collides_with);
GRAZE_SAME_MEMBER(graze_query_filter, ignored);

GRAZE_SAME_SIZE(graze_ray_hit);
GRAZE_SAME_MEMBER(graze_ray_hit, object);
GRAZE_SAME_MEMBER(graze_ray_hit, t);
GRAZE_SAME_MEMBER(graze_ray_hit, point);
GRAZE_SAME_MEMBER(graze_ray_hit, normal);
GRAZE_SAME_MEMBER(graze_ray_hit, feature);
GRAZE_SAME_MEMBER(graze_ray_hit, face);
GRAZE_SAME_MEMBER(graze_ray_hit, triangle);

GRAZE_SAME_SIZE(graze_sphere_hit);
GRAZE_SAME_MEMBER(graze_sphere_hit, object);
GRAZE_SAME_MEMBER(graze_sphere_hit, t);
GRAZE_SAME_MEMBER(graze_sphere_hit, centre);
GRAZE_SAME_MEMBER(graze_sphere_hit, point);
GRAZE_SAME_MEMBER(graze_sphere_hit, normal);
GRAZE_SAME_MEMBER(graze_sphere_hit, feature);

GRAZE_SAME_SIZE(graze_closest_point);
GRAZE_SAME_MEMBER(graze_closest_point, object);
GRAZE_SAME_MEMBER(graze_closest_point, distance);
GRAZE_SAME_MEMBER(graze_closest_point, point);
GRAZE_SAME_MEMBER(graze_closest_point, normal);
GRAZE_SAME_MEMBER(graze_closest_point, feature);
GRAZE_SAME_MEMBER(graze_closest_point, side);

}  // namespace
}  // namespace graze::c
