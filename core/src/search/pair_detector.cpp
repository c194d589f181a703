#include "core/search/pair_detector.hpp"

#include "pair/bounds.hpp"
#include "search/pair_detector_scratch.hpp"

namespace graze {
namespace {

/// Bounds that need no search: the objects' boxes, and the middle vertices of the whole objects.
void set_outer_bounds(const Surface& a, const Surface& b, PairAnswer& answer) {
  const std::uint32_t middle_a = a.mesh().regions().region(0).middle;
  const std::uint32_t middle_b = b.mesh().regions().region(0).middle;
  answer.distance = {lower_distance(a.box(), b.box()),
                     upper_distance(a.position(middle_a), b.position(middle_b))};
  answer.witness = {{FeatureKind::vertex, middle_a},
                    {FeatureKind::vertex, middle_b},
                    a.position(middle_a),
                    b.position(middle_b)};
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
  answer.contacts.clear();
  answer.region_distances.clear();
  answer.region_distances_left_out = 0;
  set_outer_bounds(a, b, answer);
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
