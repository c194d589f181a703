#include "core/search/large_pair.hpp"

#include "paper/region_distances.hpp"
#include "search/pair_detector_scratch.hpp"
#include "search/pair_search.hpp"

namespace graze {

/// The search, and then the distances of regions where they are asked for.
struct LargePair::Stages {
  const Surface* a = nullptr;
  const Surface* b = nullptr;
  PairQuery query;
  PairAnswer* answer = nullptr;
  PairSearch search;
  bool searched = false;
  RegionDistances distances;
};

LargePair::LargePair() : stages_(std::make_unique<Stages>()) {}
LargePair::~LargePair() = default;
LargePair::LargePair(LargePair&&) noexcept = default;
LargePair& LargePair::operator=(LargePair&&) noexcept = default;

void LargePair::begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
                      PairAnswer& answer) {
  stages_->a = &a;
  stages_->b = &b;
  stages_->query = query;
  stages_->answer = &answer;
  stages_->searched = false;
  stages_->search.begin(a, b, query, front, answer, true);
}

bool LargePair::advance(PairDetector& detector, PairCounters& counters) {
  Stages& stages = *stages_;
  if (!stages.searched) {
    if (!stages.search.advance(detector.scratch_->memory, counters)) return false;
    stages.searched = true;
    if (stages.query.region_distance_limit == 0) return true;
    stages.distances.begin(*stages.a, *stages.b, stages.query, *stages.answer, true);
  }
  return stages.distances.advance();
}

std::size_t LargePair::slice_count() const {
  return stages_->searched ? stages_->distances.slice_count() : stages_->search.slice_count();
}

void LargePair::run_slice(std::size_t index, PairDetector& detector, PairCounters& counters) {
  if (stages_->searched)
    stages_->distances.run_slice(index);
  else
    stages_->search.run_slice(index, detector.scratch_->memory, counters);
}

std::size_t LargePair::byte_count() const {
  return sizeof(Stages) + stages_->search.byte_count() + stages_->distances.byte_count();
}

}  // namespace graze
