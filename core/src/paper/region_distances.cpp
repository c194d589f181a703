#include "paper/region_distances.hpp"

#include <algorithm>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/base/cut_by_work.hpp"
#include "core/mesh/pair_room.hpp"
#include "pair/bounds.hpp"
#include "paper/paper.hpp"

namespace graze {
namespace {

/// Pairs tested by a slice, some tens of microseconds of work.
constexpr std::size_t pairs_each = 256;

/// The regions that replace a region one level down: a leaf stays.
struct Below {
  Below(const Region& region, std::uint32_t index)
      : first(region.is_leaf() ? index : region.first_child),
        count(region.is_leaf() ? 1 : region.child_count) {}
  std::uint32_t first;
  std::uint32_t count;
};

}  // namespace

/// The test by one thread of the pairs below others.
class RegionDistances::Test {
 public:
  explicit Test(const RegionDistances& walk)
      : query_(walk.query_),
        pair_{*walk.a_, *walk.b_, decisions_},
        bounds_(*walk.a_, *walk.b_, boxes_for(walk.query_.detail)),
        room_(query_.region_distance_limit - walk.answer_->region_distances.size()) {}
  Test(const Test&) = delete;
  Test& operator=(const Test&) = delete;

  void test_below(const RegionPair& parents, Slice& slice) const {
    const Region& parent_a = region_a(parents.a);
    const Region& parent_b = region_b(parents.b);
    if (parent_a.is_leaf() && parent_b.is_leaf()) return;
    const Below below_a(parent_a, parents.a);
    const Below below_b(parent_b, parents.b);
    for (std::uint32_t i = 0; i < below_a.count; ++i)
      for (std::uint32_t j = 0; j < below_b.count; ++j) test({below_a.first + i, below_b.first + j}, slice);
  }

 private:
  [[nodiscard]] const Region& region_a(std::uint32_t index) const {
    return pair_.a.mesh().regions().region(index);
  }
  [[nodiscard]] const Region& region_b(std::uint32_t index) const {
    return pair_.b.mesh().regions().region(index);
  }

  void test(const RegionPair& regions, Slice& slice) const {
    const Region& a = region_a(regions.a);
    const Region& b = region_b(regions.b);
    if (!is_alive(regions, a, b)) return;
    if (slice.alive.size() == room_) {
      ++slice.left_out;
      return;
    }
    const Eigen::Vector3d point_a = pair_.a.position(a.middle);
    const Eigen::Vector3d point_b = pair_.b.position(b.middle);
    slice.alive.push_back({std::max(a.level, b.level), regions.a, regions.b, a.middle, b.middle, point_a,
                           point_b, (point_b - point_a).norm()});
  }
  /// Eq. 4 in AccuracyMode::paper, otherwise the certified bound.
  [[nodiscard]] bool is_alive(const RegionPair& regions, const Region& a, const Region& b) const {
    if (query_.mode == AccuracyMode::paper) return passes_as_in_paper(pair_, query_, a, b);
    const double lower =
        is_about_vertices(query_.detail) ? bounds_.lower_with_spheres(regions) : bounds_.lower(regions);
    return lower < query_.region_distance_reach || lower == 0;
  }

  const PairQuery& query_;
  DecisionCount decisions_;
  const SurfacePair pair_;
  const RegionBounds bounds_;
  const std::size_t room_;  ///< room left when the level was cut
};

/// The pair of roots is where the walk begins and no distance of its own.
void RegionDistances::begin(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer,
                            bool sliced) {
  a_ = &a;
  b_ = &b;
  query_ = query;
  answer_ = &answer;
  sliced_ = sliced;
  answer.region_distances.clear();
  answer.region_distances_left_out = 0;
  slice_count_ = 0;
  Test(*this).test_below({}, add_slice(0, 0));
}

bool RegionDistances::advance() {
  while (true) {
    gather();
    cut();
    if (slice_count_ == 0) return true;
    if (slice_count_ > 1) return false;
    run_slice(0);
  }
}

void RegionDistances::run_slice(std::size_t index) {
  const Test test(*this);
  Slice& slice = slices_[index];
  for (std::size_t i = slice.begin; i < slice.end; ++i) {
    constexpr std::size_t clock_check_interval = 16;
    if ((i - slice.begin) % clock_check_interval == 0 && is_late()) {
      slice.left_out += slice.end - i;
      return;
    }
    const RegionDistance& listed = answer_->region_distances[i];
    test.test_below({listed.region_a, listed.region_b}, slice);
  }
}

bool RegionDistances::is_late() const {
  return query_.deadline != PairQuery::no_deadline && std::chrono::steady_clock::now() >= query_.deadline;
}

void RegionDistances::reserve_as(const RegionDistances& other) {
  if (other.slices_.empty()) return;
  if (slices_.empty()) slices_.emplace_back();
  graze::reserve_as(slices_.front().alive, other.slices_.front().alive);
}

void RegionDistances::reserve(const PairRoom& room) {
  if (slices_.empty()) slices_.emplace_back();
  slices_.front().alive.reserve(room.region_distances);
}

std::size_t RegionDistances::byte_count() const {
  std::size_t bytes = bytes_of(slices_);
  for (const Slice& slice : slices_) bytes += bytes_of(slice.alive);
  return bytes;
}

RegionDistances::Slice& RegionDistances::add_slice(std::size_t begin, std::size_t end) {
  if (slices_.size() == slice_count_) slices_.emplace_back();
  Slice& slice = slices_[slice_count_++];
  slice.begin = begin;
  slice.end = end;
  slice.alive.clear();
  slice.left_out = 0;
  return slice;
}

/// Lists the slices' results, as far as there is room.
void RegionDistances::gather() {
  auto& listed = answer_->region_distances;
  level_begin_ = listed.size();
  for (std::size_t i = 0; i < slice_count_; ++i) {
    const Slice& slice = slices_[i];
    const std::size_t taken = std::min(slice.alive.size(), query_.region_distance_limit - listed.size());
    listed.insert(listed.end(), slice.alive.begin(),
                  slice.alive.begin() + static_cast<std::ptrdiff_t>(taken));
    answer_->region_distances_left_out += slice.alive.size() - taken + slice.left_out;
  }
}

/// Makes the slices of the next level.
void RegionDistances::cut() {
  slice_count_ = 0;
  const auto& listed = answer_->region_distances;
  const std::size_t most = sliced_ ? pairs_each : std::numeric_limits<std::size_t>::max();
  cut_by_work(
      level_begin_, listed.size(), most, [&](std::size_t i) { return count_below(listed[i]); },
      [&](std::size_t begin, std::size_t end) { add_slice(begin, end); });
}

/// How many pairs replace it one level down.
std::size_t RegionDistances::count_below(const RegionDistance& listed) const {
  const Region& a = a_->mesh().regions().region(listed.region_a);
  const Region& b = b_->mesh().regions().region(listed.region_b);
  if (a.is_leaf() && b.is_leaf()) return 0;
  return std::size_t{Below(a, listed.region_a).count} * Below(b, listed.region_b).count;
}

}  // namespace graze
