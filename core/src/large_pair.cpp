#include <graze/large_pair.hpp>

#include "pair_detector_scratch.hpp"
#include "pair_search.hpp"

namespace graze {

LargePair::LargePair() : search_(std::make_unique<PairSearch>()) {}
LargePair::~LargePair() = default;
LargePair::LargePair(LargePair&&) noexcept = default;
LargePair& LargePair::operator=(LargePair&&) noexcept = default;

void LargePair::begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                      PairAnswer& answer) {
  search_->begin(a, b, query, front, answer, true);
}

bool LargePair::advance(PairDetector& detector, PairCounters& counters) {
  return search_->advance(detector.scratch_->memory, counters);
}

std::size_t LargePair::slice_count() const {
  return search_->slice_count();
}

void LargePair::run_slice(std::size_t index, PairDetector& detector, PairCounters& counters) {
  search_->run_slice(index, detector.scratch_->memory, counters);
}

}  // namespace graze
