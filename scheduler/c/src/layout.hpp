#pragma once

#include <graze/graze.h>

#include <cstddef>
#include <graze/contact_geometry.hpp>
#include <graze/contact_walk.hpp>
#include <graze/query.hpp>
#include <graze/report.hpp>
#include <graze/scene_query.hpp>
#include <span>
#include <type_traits>

// Rows of the C interface have the layout of the C++ structs, so nothing is copied (layout.cpp compares
// them).

namespace graze::c {

/// Names the C++ struct that a struct of the C interface is the same as.
template <typename Row>
struct SameAs;

template <>
struct SameAs<graze_id> : std::type_identity<ObjectId> {};
template <>
struct SameAs<graze_feature> : std::type_identity<Feature> {};
template <>
struct SameAs<graze_contact> : std::type_identity<Contact> {};
template <>
struct SameAs<graze_bounds> : std::type_identity<DistanceBounds> {};
template <>
struct SameAs<graze_witness> : std::type_identity<Witness> {};
template <>
struct SameAs<graze_way_out> : std::type_identity<WayOut> {};
template <>
struct SameAs<graze_pair> : std::type_identity<PairReport> {};
template <>
struct SameAs<graze_region_distance> : std::type_identity<RegionDistance> {};
template <>
struct SameAs<graze_impact> : std::type_identity<Impact> {};
template <>
struct SameAs<graze_contact_geometry> : std::type_identity<ContactGeometry> {};
template <>
struct SameAs<graze_followed_contact> : std::type_identity<FollowedContact> {};
template <>
struct SameAs<graze_weights> : std::type_identity<SurfaceWeights> {};
template <>
struct SameAs<graze_patch_pair> : std::type_identity<PatchPair> {};
template <>
struct SameAs<graze_patch_answer> : std::type_identity<PatchAnswer> {};
template <>
struct SameAs<graze_query_filter> : std::type_identity<QueryFilter> {};
template <>
struct SameAs<graze_ray_hit> : std::type_identity<RayHit> {};
template <>
struct SameAs<graze_sphere_hit> : std::type_identity<SphereHit> {};
template <>
struct SameAs<graze_closest_point> : std::type_identity<ClosestPoint> {};

/// Returns a value of C as one of C++, or the other way round.
template <typename To, typename From>
[[nodiscard]] To same(const From& value) {
  static_assert(sizeof(To) == sizeof(From));
  To made;
  std::memcpy(static_cast<void*>(&made), static_cast<const void*>(&value), sizeof made);
  return made;
}

/// Returns an array of a caller's as the C++ structs that it holds.
template <typename Row>
[[nodiscard]] auto* cpp_rows(Row* rows) {
  using Same = typename SameAs<std::remove_const_t<Row>>::type;
  return reinterpret_cast<std::conditional_t<std::is_const_v<Row>, const Same, Same>*>(rows);
}

/// Returns an array of C++ structs as a caller reads it, and how many there are.
template <typename Row, typename Same>
[[nodiscard]] const Row* c_rows(std::span<const Same> rows, std::size_t* count) {
  static_assert(std::is_same_v<typename SameAs<Row>::type, Same>);
  if (count != nullptr) *count = rows.size();
  return reinterpret_cast<const Row*>(rows.data());
}

}  // namespace graze::c
