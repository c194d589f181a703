#include "region_distances.hpp"

#include <algorithm>

#include "bounds.hpp"
#include "paper.hpp"

namespace graze {
namespace {

class RegionDistances {
 public:
  RegionDistances(const SurfacePair& pair, const PairQuery& query, PairAnswer& answer)
      : pair_(pair),
        query_(query),
        answer_(answer),
        bounds_(pair.a, pair.b, is_about_vertices(query.detail)) {}

  /// Whether the pair is alive: eq. 4 in AccuracyMode::paper, otherwise the certified bound. The pair of
  /// roots is where the walk begins and no distance of its own.
  bool offer(const RegionPair& regions, const Region& a, const Region& b) {
    const std::uint32_t level = std::max(a.level, b.level);
    if (level == 0) return true;
    if (!is_alive(regions, a, b)) return false;
    if (answer_.region_distances.size() == query_.region_distance_limit) {
      ++answer_.region_distances_left_out;
      return false;
    }
    const Eigen::Vector3d& point_a = pair_.a.position(a.middle);
    const Eigen::Vector3d& point_b = pair_.b.position(b.middle);
    answer_.region_distances.push_back(
        {level, regions.a, regions.b, a.middle, b.middle, point_a, point_b, (point_b - point_a).norm()});
    return true;
  }

 private:
  [[nodiscard]] bool is_alive(const RegionPair& regions, const Region& a, const Region& b) const {
    if (query_.mode == AccuracyMode::paper) return passes_as_in_paper(pair_, query_, a, b);
    const double lower = bounds_.lower(regions);
    return lower < query_.region_distance_reach || lower == 0;
  }

  const SurfacePair& pair_;
  const PairQuery& query_;
  PairAnswer& answer_;
  RegionBounds bounds_;
};

}  // namespace

void find_region_distances(const SurfacePair& pair, const PairQuery& query, DmvScratch& scratch,
                           PairAnswer& answer) {
  answer.region_distances.clear();
  answer.region_distances_left_out = 0;
  RegionDistances distances(pair, query, answer);
  PairCounters not_counted;
  WorkMeter meter(PairQuery{}, not_counted);
  scratch.front.assign(1, RegionPair{});
  dmv(
      pair.a.mesh().regions(), pair.b.mesh().regions(), scratch, meter,
      [&](const RegionPair& regions, const Region& a, const Region& b) {
        const bool alive = distances.offer(regions, a, b);
        return Expansion{alive, alive};
      },
      [&](const RegionPair& leaves, const Region& a, const Region& b) { distances.offer(leaves, a, b); });
}

}  // namespace graze
