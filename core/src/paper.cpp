#include "paper.hpp"

#include <algorithm>

#include "bounds.hpp"
#include "closest_vertices.hpp"
#include "leaf_vertex_pairs.hpp"

namespace graze {
namespace {

ContactName middles_of(const Region& a, const Region& b) {
  return ContactName::of(vertex_piece(a.middle), vertex_piece(b.middle));
}

double epsilon_of(const SurfacePair& pair, const PairQuery& query, const Region& a, const Region& b) {
  if (query.epsilon.empty()) return pair.a.level_radii()[a.level] + pair.b.level_radii()[b.level];
  const std::size_t level = std::max<std::size_t>(1, std::max(a.level, b.level));
  const std::size_t last = std::max<std::size_t>(1, query.epsilon.size() - 1);
  return query.epsilon[std::min(level, last) - 1];
}

/// What is nearer than the threshold, for a look at pairs of vertices.
struct VerticesBelow {
  double threshold;

  [[nodiscard]] double limit() const { return threshold; }
  [[nodiscard]] bool keep(double lower) const { return lower < threshold; }
  void left_out(double /*limit*/) const {}
};

class Paper {
 public:
  Paper(const SurfacePair& pair, const PairQuery& query, PaperScratch& scratch, WorkMeter& meter,
        std::vector<ContactName>& names)
      : pair_(pair),
        query_(query),
        scratch_(scratch),
        meter_(meter),
        names_(names),
        bounds_(pair.a, pair.b, RefitOf::vertices),
        nearest_(pair, Ties::lowest, scratch.closest) {}

  PaperFound run() {
    scratch_.closest.clear();
    scratch_.dmv.front.assign(1, RegionPair{});
    found_.complete = dmv(
        pair_.a.mesh().regions(), pair_.b.mesh().regions(), scratch_.dmv, meter_,
        [&](const RegionPair& regions, const Region& a, const Region& b) {
          const bool both = expand(regions, a, b);
          return Expansion{both, both};
        },
        [](const RegionPair&) { return true; },
        [&](const RegionPair& leaves, const Region& a, const Region& b) {
          dv({a, pair_.a.vertex_boxes()[leaves.a]}, {b, pair_.b.vertex_boxes()[leaves.b]});
        });
    std::sort(names_.begin(), names_.end());
    names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
    return found_;
  }

 private:
  /// Eq. 4: expand when the middle vertices are closer than the level's epsilon; the pair of roots always.
  bool expand(const RegionPair& regions, const Region& a, const Region& b) {
    if (std::max(a.level, b.level) == 0) return true;
    nearest_.offer(middles_of(a, b));
    if (passes_as_in_paper(pair_, query_, a, b)) return true;
    found_.lower = std::min(found_.lower, bounds_.lower_with_spheres(regions));
    return false;
  }

  /// DV at two leaves: from their closest vertices (eq. 5) along the meshes' edges while the distance
  /// shrinks.
  void dv(const LeafOf& leaf_a, const LeafOf& leaf_b) {
    ++meter_.counters().leaf_pairs_tested;
    ContactName name = closest_vertices(pair_, leaf_a, leaf_b, scratch_.leaves, scratch_.leaf_closest);
    nearest_.offer(name);
    found_.lower = std::min(found_.lower, lower_distance(pair_.a.position(name.a().feature.index),
                                                         pair_.b.position(name.b().feature.index)));
    if (query_.detail == ContactDetail::vertices) return add_close_vertices(leaf_a, leaf_b);
    while (step_to_neighbour(name)) {
    }
    nearest_.offer(name);
    if (is_closer_than(pair_, name, query_.threshold)) names_.push_back(name);
  }

  void add_close_vertices(const LeafOf& leaf_a, const LeafOf& leaf_b) {
    const VerticesBelow range{query_.threshold};
    for_each_vertex_pair(pair_, leaf_a, leaf_b, scratch_.leaves, range,
                         [&](std::uint32_t a, std::uint32_t b) {
                           const auto name = ContactName::of(vertex_piece(a), vertex_piece(b));
                           if (is_closer_than(pair_, name, query_.threshold)) names_.push_back(name);
                         });
  }

  /// Moves both ends to the nearest of their neighbours and themselves; false where nothing is nearer.
  bool step_to_neighbour(ContactName& name) {
    scratch_.leaf_closest.clear();
    ClosestSet around(pair_, Ties::lowest, scratch_.leaf_closest);
    around.offer(name);
    const std::uint32_t a = name.a().feature.index;
    const std::uint32_t b = name.b().feature.index;
    const auto offer = [&](std::uint32_t to_a, std::uint32_t to_b) {
      if (lower_distance(pair_.a.position(to_a), pair_.b.position(to_b)) <= around.upper())
        around.offer(ContactName::of(vertex_piece(to_a), vertex_piece(to_b)));
    };
    for (const std::uint32_t to_a : pair_.a.mesh().vertex_neighbours(a)) {
      offer(to_a, b);
      for (const std::uint32_t to_b : pair_.b.mesh().vertex_neighbours(b)) offer(to_a, to_b);
    }
    for (const std::uint32_t to_b : pair_.b.mesh().vertex_neighbours(b)) offer(a, to_b);
    const ContactName nearest = around.front();
    if (compare_distances(pair_, nearest, name) >= 0) return false;
    name = nearest;
    return true;
  }

  const SurfacePair& pair_;
  const PairQuery& query_;
  PaperScratch& scratch_;
  WorkMeter& meter_;
  std::vector<ContactName>& names_;
  RegionBounds bounds_;
  ClosestSet nearest_;
  PaperFound found_;
};

}  // namespace

bool passes_as_in_paper(const SurfacePair& pair, const PairQuery& query, const Region& a, const Region& b) {
  return is_closer_than(pair, middles_of(a, b), epsilon_of(pair, query, a, b));
}

PaperFound find_as_in_paper(const SurfacePair& pair, const PairQuery& query, PaperScratch& scratch,
                            WorkMeter& meter, std::vector<ContactName>& names) {
  return Paper(pair, query, scratch, meter, names).run();
}

}  // namespace graze
