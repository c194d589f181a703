#include "vertex_sweep.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "listed_vertices.hpp"

namespace graze {

namespace {

/// More vertices of one surface, or pairs of vertices to be compared, are too many.
constexpr std::size_t most_vertices = 4096;
constexpr std::size_t most_pairs = std::size_t{1} << 18;
/// Regions of no more vertices are not gone into further.
constexpr std::uint32_t small_region = 64;
/// So few pairs are all compared.
constexpr std::size_t few_pairs = 2048;
constexpr std::size_t most_slabs = 256;
/// So many slabs are as thick as what is looked for, so that those about a vertex are little thicker than
/// they must be.
constexpr float slabs_of_limit = 4;

/// Cuts a box into slabs along its longest side.
class Slabs {
 public:
  Slabs(const kernels::BoxInFrame& box, float limit) {
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (box.max[axis] - box.min[axis] > box.max[axis_] - box.min[axis_]) axis_ = axis;
    first_ = box.min[axis_];
    const float length = box.max[axis_] - first_;
    const float count = std::min(length / (limit / slabs_of_limit), static_cast<float>(most_slabs));
    per_unit_ = length > 0 && count > 1 ? count / length : 0;
    last_ = per_unit_ > 0 ? count - 1 : 0;
  }
  [[nodiscard]] std::size_t axis() const { return axis_; }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(last_) + 1; }
  /// The slab of a coordinate, or that at the end where it lies beyond; ascends with the coordinate.
  [[nodiscard]] std::uint32_t at(float coordinate) const {
    const float place = (coordinate - first_) * per_unit_;
    const float above = place > 0 ? place : 0;
    // Through an int, which vectors can do.
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(above < last_ ? above : last_));
  }

 private:
  std::size_t axis_ = 0;
  float first_ = 0;
  float per_unit_ = 0;
  float last_ = 0;
};

class VertexSweep {
 public:
  VertexSweep(const SurfacePair& pair, double limit, VertexSweepScratch& scratch, WorkMeter& meter,
              std::vector<ContactName>& names)
      : pair_(pair),
        limit_(limit),
        scratch_(scratch),
        meter_(meter),
        names_(names),
        near_both_(near_both(pair, limit)),
        frame_(near_both_, near_both_),
        local_limit_(frame_.to_local_limit(limit)),
        reach_(reach_of(frame_, near_both_, limit)) {}

  Swept run() {
    names_.clear();
    if (near_both_.empty()) return Swept::all;
    Box box_a;
    Box box_b;
    if (!collect(pair_.b, near_both_, scratch_.b, box_b)) return gave_up_;
    if (scratch_.b.count() == 0) return Swept::all;
    if (!collect(pair_.a, common(near_both_, grown(box_b, limit_)), scratch_.a, box_a)) return gave_up_;
    if (scratch_.a.count() == 0) return Swept::all;
    scratch_.rows.make_room(scratch_.a.count(), scratch_.b.count());
    if (scratch_.a.count() * scratch_.b.count() <= few_pairs) {
      std::fill_n(scratch_.rows.first.begin(), scratch_.a.count(), 0U);
      std::fill_n(scratch_.rows.last.begin(), scratch_.a.count(),
                  static_cast<std::uint32_t>(scratch_.b.count()));
      compare_with(scratch_.b);
      return Swept::all;
    }
    const Slabs slabs(frame_.to_local(common(box_b, grown(box_a, limit_))), local_limit_);
    sort_into(slabs);
    if (list_beside(slabs) > most_pairs) return Swept::too_many;
    compare_with(scratch_.sorted);
    return Swept::all;
  }

 private:
  /// Where vertices of either may be near the other.
  static Box near_both(const SurfacePair& pair, double limit) {
    Box both = pair.a.box();
    both.add(pair.b.box());
    return common(both, common(grown(pair.a.box(), limit), grown(pair.b.box(), limit)));
  }

  /// The surface's vertices in the box, and their box; false where they are too many or the budget is spent.
  bool collect(const Surface& surface, const Box& box, LocalVertices& vertices, Box& found_box) {
    std::size_t count = 0;
    if (surface.mesh().vertex_count() <= Surface::most_searched) {
      if (!meter_.spend()) return give_up(Swept::out_of_budget);
      make_room(surface.mesh().vertex_count() + Surface::beyond_found);
      count = surface.find_inside(box, scratch_.found);
    } else {
      if (!collect_from_tree(surface, box, count)) return false;
      // Names then come in the order of those of a.
      if (&surface == &pair_.a)
        std::sort(scratch_.found.begin(), scratch_.found.begin() + static_cast<std::ptrdiff_t>(count));
    }
    found_box = vertices.take(surface, std::span(scratch_.found).first(count), frame_);
    return true;
  }
  bool collect_from_tree(const Surface& surface, const Box& box, std::size_t& count) {
    const RegionTree& tree = surface.mesh().regions();
    const auto boxes = surface.boxes(RefitOf::vertices);
    // The regions' boxes are of where the vertices were.
    const Box reached = grown(box, surface.motion_since_vertex_refit());
    const InsideBox inside(surface, box);
    make_room(most_vertices + small_region);
    scratch_.regions.assign(1, 0);
    while (!scratch_.regions.empty()) {
      const std::uint32_t index = scratch_.regions.back();
      scratch_.regions.pop_back();
      if (!meter_.spend()) return give_up(Swept::out_of_budget);
      if (common(boxes[index], reached).empty()) continue;
      const Region& region = tree.region(index);
      if (region.is_leaf() || region.vertex_count <= small_region) {
        const auto vertices = tree.vertices(region);
        for (std::size_t first = 0; first < vertices.size(); first += small_region) {
          const auto some =
              vertices.subspan(first, std::min<std::size_t>(small_region, vertices.size() - first));
          count += inside.find(some, scratch_.found.data() + count);
          if (count > most_vertices) return give_up(Swept::too_many);
        }
      } else {
        for (std::uint32_t child = region.child_count; child-- > 0;)
          scratch_.regions.push_back(region.first_child + child);
      }
    }
    return true;
  }
  void make_room(std::size_t count) {
    if (scratch_.found.size() < count) scratch_.found.resize(count);
  }
  bool give_up(Swept why) {
    gave_up_ = why;
    return false;
  }

  /// The vertices of b, slab by slab.
  void sort_into(const Slabs& slabs) {
    const LocalVertices& b = scratch_.b;
    auto& slab_of = scratch_.slab;
    auto& begin = scratch_.begin;
    slab_of.resize(b.count());
    begin.assign(slabs.count() + 1, 0);
    const std::span<const float> along = b.coordinates(slabs.axis());
    for (std::size_t i = 0; i < along.size(); ++i) slab_of[i] = slabs.at(along[i]);
    for (const std::uint32_t slab : slab_of) ++begin[slab];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    make_room(b.count() + LocalVertices::padding);
    std::fill_n(scratch_.found.begin() + static_cast<std::ptrdiff_t>(b.count()), LocalVertices::padding, 0U);
    for (std::size_t i = b.count(); i-- > 0;)
      scratch_.found[--begin[slab_of[i]]] = static_cast<std::uint32_t>(i);
    scratch_.sorted.take(b, std::span(scratch_.found).first(b.count()));
  }

  /// For each vertex of a those of b in the slabs about it; how many in all.
  std::size_t list_beside(const Slabs& slabs) {
    const std::span<const float> along = scratch_.a.coordinates(slabs.axis());
    std::uint32_t* const first = scratch_.rows.first.data();
    std::uint32_t* const last = scratch_.rows.last.data();
    for (std::size_t row = 0; row < along.size(); ++row) first[row] = slabs.at(along[row] - reach_);
    for (std::size_t row = 0; row < along.size(); ++row) last[row] = slabs.at(along[row] + reach_);
    std::size_t pairs = 0;
    for (std::size_t row = 0; row < along.size(); ++row) {
      first[row] = scratch_.begin[first[row]];
      last[row] = scratch_.begin[last[row] + std::size_t{1}];
      pairs += last[row] - first[row];
    }
    return pairs;
  }

  void compare_with(const LocalVertices& b) {
    add_close_rows(pair_, limit_, {scratch_.a, b}, reach_, scratch_.rows, names_);
  }

  const SurfacePair& pair_;
  double limit_;
  VertexSweepScratch& scratch_;
  WorkMeter& meter_;
  std::vector<ContactName>& names_;
  Box near_both_;
  FilterFrame frame_;
  float local_limit_;
  float reach_;  ///< what is not nearer in float is certainly not nearer than the limit
  Swept gave_up_ = Swept::all;
};

}  // namespace

Swept sweep_close_vertices(const SurfacePair& pair, double limit, VertexSweepScratch& scratch,
                           WorkMeter& meter, std::vector<ContactName>& names) {
  return VertexSweep(pair, limit, scratch, meter, names).run();
}

void VertexSweepScratch::reserve(const PairRoom& room) {
  const std::size_t most = std::min(most_vertices, room.vertices);
  if (found.size() < most_vertices + small_region) found.resize(most_vertices + small_region);
  constexpr std::size_t children_left = 7 * std::size_t{RegionTree::max_level} + 1;
  regions.reserve(std::min(children_left, room.regions));
  for (LocalVertices* const vertices : {&a, &b, &sorted}) vertices->reserve(most);
  slab.reserve(most);
  begin.reserve(most_slabs + 1);
  rows.make_room(most, most);
}

}  // namespace graze
