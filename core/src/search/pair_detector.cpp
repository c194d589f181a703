#include "core/search/pair_detector.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "core/pair/group_filter.hpp"
#include "pair/bounds.hpp"
#include "search/pair_detector_scratch.hpp"

namespace graze {
namespace {

/// A vertex of each surface that may be tested: the middle vertex of the whole, or the corner of a face. It
/// is not there where none is known, of one surface with itself.
std::optional<std::array<std::uint32_t, 2>> some_vertices(const Surface& a, const Surface& b,
                                                          const FeatureFilter* groups) {
  const std::uint32_t middle_a = a.mesh().regions().region(0).middle;
  const std::uint32_t middle_b = b.mesh().regions().region(0).middle;
  if (groups == nullptr || (!groups->is_of_self() && groups->may_vertices(middle_a, middle_b)))
    return std::array{middle_a, middle_b};
  return groups->some_vertices(a.mesh(), b.mesh());
}

/// Bounds that need no search: the objects' boxes, and two of their vertices.
void set_outer_bounds(const Surface& a, const Surface& b, const FeatureFilter* groups, PairAnswer& answer) {
  const auto some = some_vertices(a, b, groups);
  answer.distance = {lower_distance(a.box(), b.box()), std::numeric_limits<double>::infinity()};
  answer.witness = {};
  if (!some) return;
  std::uint32_t vertex_a = (*some)[0];
  std::uint32_t vertex_b = (*some)[1];
  if (&a == &b && vertex_b < vertex_a) std::swap(vertex_a, vertex_b);
  answer.distance.upper = upper_distance(a.position(vertex_a), b.position(vertex_b));
  answer.witness = {{FeatureKind::vertex, vertex_a},
                    {FeatureKind::vertex, vertex_b},
                    a.position(vertex_a),
                    b.position(vertex_b)};
}

}  // namespace

PairDetector::PairDetector() : scratch_(std::make_unique<Scratch>()) {}
PairDetector::~PairDetector() = default;
PairDetector::PairDetector(PairDetector&&) noexcept = default;
PairDetector& PairDetector::operator=(PairDetector&&) noexcept = default;

void PairDetector::reserve_as(const PairDetector& other) {
  scratch_->search.reserve_as(other.scratch_->search);
  graze::reserve_as(scratch_->memory, other.scratch_->memory);
  scratch_->region_distances.reserve_as(other.scratch_->region_distances);
}

void PairDetector::reserve(const PairRoom& room) {
  scratch_->search.reserve(room);
  graze::reserve(scratch_->memory, room);
  scratch_->region_distances.reserve(room);
}

void PairDetector::reserve_for_solids(const PairRoom& room) {
  scratch_->search.reserve_for_solids();
  scratch_->memory.solid.reserve_for_solids(room);
}

void PairDetector::reserve_for_ways_out(const PairRoom& room) {
  scratch_->memory.way_out.reserve_for_ways_out(room);
}

void PairDetector::reserve_for_limit(std::size_t most, const PairRoom& room) {
  scratch_->search.reserve_for_limit(most, room);
  scratch_->memory.nearest_keys.contacts.reserve(room.contacts);
}

std::size_t PairDetector::byte_count() const {
  return sizeof(Scratch) + scratch_->search.byte_count() + bytes_of(scratch_->memory) +
         scratch_->region_distances.byte_count() + scratch_->no_front.byte_count();
}

void PairDetector::outer_bounds(const Surface& a, const Surface& b, const PairQuery& query,
                                PairAnswer& answer) {
  answer.in_contact = false;
  answer.complete = false;
  answer.cut = false;
  answer.inside = Inside::none;
  answer.way_out = {};
  answer.contacts.clear();
  answer.region_distances.clear();
  answer.region_distances_left_out = 0;
  set_outer_bounds(a, b, query.groups, answer);
  answer.listed = answer.distance.lower < query.reach || answer.distance.lower == 0;
}

void PairDetector::detect(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer,
                          PairCounters& counters) {
  scratch_->no_front.forget();
  detect(a, b, query, scratch_->no_front, answer, counters);
}

void PairDetector::detect(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                          PairAnswer& answer, PairCounters& counters) {
  scratch_->search.begin(a, b, query, front, answer, false);
  scratch_->search.advance(scratch_->memory, counters);
}

void PairDetector::region_distances(const Surface& a, const Surface& b, const PairQuery& query,
                                    PairAnswer& answer) {
  scratch_->region_distances.begin(a, b, query, answer, false);
  scratch_->region_distances.advance();
}

}  // namespace graze
