#include "core/sweep/pair_sweep.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/bytes_of.hpp"
#include "pair/region_expansion.hpp"
#include "sweep/leaf_sweep.hpp"

namespace graze {
namespace {

/// A walk goes to the depth first. So it holds no more pairs than this in trees of twenty levels.
constexpr std::size_t reserved_region_pairs = 1024;

/// The order of impacts in an answer. No two impacts of a pair have the same features.
bool comes_before(const Impact& left, const Impact& right) {
  return std::tie(left.lower, left.kind, left.feature_a, left.feature_b) <
         std::tie(right.lower, right.kind, right.feature_a, right.feature_b);
}

}  // namespace

struct PairSweep::Scratch {
  std::vector<RegionPair> open;  ///< pairs of regions that the walk has still to test
  MovingFeatures of_a;
  MovingFeatures of_b;

  template <typename Self>
  static auto lists(Self& self) {
    return std::tuple_cat(std::tie(self.open), MovingFeatures::parts(self.of_a),
                          MovingFeatures::parts(self.of_b));
  }
};

namespace {

/// Goes down the regions of two surfaces that may meet on the way.
class SweepWalk {
 public:
  SweepWalk(const MovingSurface& a, const MovingSurface& b, const SweepQuery& query,
            std::vector<RegionPair>& open, SweepWork& work)
      : a_(a), b_(b), query_(query), open_(open), work_(work), last_allowed_(query.work_limit) {}

  /// Calls `use(pair)` with each pair of leaves that may meet. Returns false if the budget ran out before the
  /// end.
  template <typename Use>
  bool run(const Use& use) {
    open_.assign(1, RegionPair{0, 0});
    std::uint64_t tested = 0;
    for (; !open_.empty(); ++tested) {
      if (tested >= last_allowed_) return false;
      const RegionPair pair = open_.back();
      open_.pop_back();
      ++work_.region_pairs_tested;
      if (!may_meet(pair)) continue;
      if (!region_a(pair).is_leaf() || !region_b(pair).is_leaf()) {
        expand(pair);
        continue;
      }
      if (is_late()) return false;
      use(pair);
    }
    return true;
  }

  [[nodiscard]] const Region& region_a(const RegionPair& pair) const {
    return a_.mesh().regions().region(pair.a);
  }
  [[nodiscard]] const Region& region_b(const RegionPair& pair) const {
    return b_.mesh().regions().region(pair.b);
  }

 private:
  [[nodiscard]] bool is_late() const {
    return query_.deadline != PairQuery::no_deadline && std::chrono::steady_clock::now() >= query_.deadline;
  }
  [[nodiscard]] bool may_meet(const RegionPair& pair) const {
    if (query_.groups != nullptr && !query_.groups->may_regions(pair)) return false;
    const MovingBox& box = a_.face_boxes[pair.a];
    const MovingBox& other = b_.face_boxes[pair.b];
    return first_meeting(query_.gap > 0 ? grown(box, query_.gap) : box, other) <= 1;
  }

  void expand(const RegionPair& pair) {
    const auto push = [&](const RegionPair& child) { open_.push_back(child); };
    const Region& a = region_a(pair);
    const Region& b = region_b(pair);
    if (query_.is_self && pair.a == pair.b) return visit_with_itself(a, push);
    const Expansion expansion =
        expansion_by_size(a, a_.face_boxes[pair.a].size(), b, b_.face_boxes[pair.b].size());
    RegionChildren(pair, a, b, expansion).visit(push);
  }

  const MovingSurface& a_;
  const MovingSurface& b_;
  const SweepQuery& query_;
  std::vector<RegionPair>& open_;
  SweepWork& work_;
  std::uint64_t last_allowed_;
};

/// Leaves nothing but that nothing is known.
void set_unknown(SweepAnswer& answer) {
  answer.complete = false;
  answer.impacts.clear();
  answer.time_of_impact = answer.time_of_gap = 0;
}

void keep_earliest(std::vector<Impact>& impacts, std::size_t limit, std::size_t& left_out) {
  std::sort(impacts.begin(), impacts.end(), comes_before);
  if (limit == 0 || impacts.size() <= limit) return;
  left_out = impacts.size() - limit;
  impacts.resize(limit);
}

}  // namespace

PairSweep::PairSweep() : scratch_(std::make_unique<Scratch>()) {}
PairSweep::~PairSweep() = default;
PairSweep::PairSweep(PairSweep&&) noexcept = default;
PairSweep& PairSweep::operator=(PairSweep&&) noexcept = default;

void PairSweep::sweep(const MovingSurface& a, const MovingSurface& b, const SweepQuery& query,
                      SweepAnswer& answer, SweepWork& work) {
  static_cast<SweepFinding&>(answer) = {};
  answer.impacts.clear();
  Scratch& scratch = *scratch_;
  SweepWalk walk(a, b, query, scratch.open, work);
  LeafSweep leaves(a, b, query, answer, work);
  const bool is_whole = walk.run([&](const RegionPair& pair) {
    const MovingBox box_a = query.gap > 0 ? grown(a.face_boxes[pair.a], query.gap) : a.face_boxes[pair.a];
    scratch.of_a.collect(a, walk.region_a(pair), b.face_boxes[pair.b], query.gap);
    scratch.of_b.collect(b, walk.region_b(pair), box_a, 0);
    leaves.test(scratch.of_a, scratch.of_b, query.is_self && pair.a == pair.b);
  });
  if (!is_whole) return set_unknown(answer);
  keep_earliest(answer.impacts, query.impact_limit, answer.left_out);
}

void PairSweep::reserve(const PairRoom& room) {
  scratch_->open.reserve(reserved_region_pairs);
  scratch_->of_a.reserve(room);
  scratch_->of_b.reserve(room);
}

void PairSweep::reserve_as(const PairSweep& other) {
  std::apply(
      [&](auto&... mine) {
        std::apply([&](const auto&... theirs) { (mine.reserve(theirs.capacity()), ...); },
                   Scratch::lists(*other.scratch_));
      },
      Scratch::lists(*scratch_));
}

std::size_t PairSweep::byte_count() const {
  return std::apply([](const auto&... lists) { return (std::size_t{0} + ... + bytes_of(lists)); },
                    Scratch::lists(*scratch_));
}

}  // namespace graze
