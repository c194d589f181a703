#include "near_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "passes_for.hpp"
#include "validate.hpp"

namespace graze {
namespace {

constexpr std::size_t block_size = VertexBlocks::block_size;
constexpr std::size_t group_size = VertexBlocks::group_size;

/// So many blocks of b are looked at one after the other, beside each block of a; of more by their levels.
constexpr std::size_t few_blocks = 8 * group_size;
/// So many boxes of b are gone through for a block of a as quickly as they are sorted out for several before.
constexpr std::size_t few_at_once = 4 * group_size;
/// So many blocks of a in one group of sixteen are worth it.
constexpr std::size_t least_run = 4;
/// Blocks of b whose points are compared at once.
constexpr std::size_t blocks_at_once = 128;

/// How much nearer boxes of blocks may seem in float, relative to the numbers that say where they are: half
/// of a unit of 2^-23 each for two coordinates about their origins, for where these are to each other, for
/// what is looked for, and for three sums of them. A coordinate that is far from those it is compared with
/// may lose more, and is as far on.
constexpr float margin = 0x1p-20F;
/// What small numbers lose in float.
constexpr float lost = 0x1p-140F;

float as_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return value > most ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
}

kernels::Block rows_of(const VertexBlocks::Level& level) {
  return {level.rows, level.stride, level.count};
}

/// What boxes are compared with in place of a box that is elsewhere: it is `by` from there, and grown.
kernels::BoxInFrame moved(const kernels::BoxInFrame& box, const Eigen::Vector3f& by, float grown) {
  kernels::BoxInFrame moved{};
  for (int axis = 0; axis < 3; ++axis) {
    const float away = std::abs(by[axis]) + grown;
    moved.min[axis] = box.min[axis] + by[axis] - (grown + (std::abs(box.min[axis]) + away) * margin + lost);
    moved.max[axis] = box.max[axis] + by[axis] + (grown + (std::abs(box.max[axis]) + away) * margin + lost);
  }
  return moved;
}

/// A surface's box about the origin of another's blocks, grown.
kernels::BoxInFrame box_about(const VertexBlocks& blocks, const Box& box, float grown) {
  kernels::BoxInFrame about{};
  for (int axis = 0; axis < 3; ++axis) {
    about.min[axis] = static_cast<float>(box.min[axis] - blocks.origin()[axis]);
    about.max[axis] = static_cast<float>(box.max[axis] - blocks.origin()[axis]);
  }
  return moved(about, Eigen::Vector3f::Zero(), grown);
}

kernels::Block rows_of(const BoxRows& boxes) {
  return {boxes.rows.data(), boxes.stride, boxes.stride};
}

std::size_t groups_in(const VertexBlocks::Level& level) {
  return (level.count + group_size - 1) / group_size;
}

/// The blocks whose boxes meet another one, ascending: level by level, from the last down. There is room for
/// all in both lists, whatever is found, so that the same surfaces never take more.
void find_meeting(const VertexBlocks& blocks, const kernels::BoxInFrame& box, IndexList& groups,
                  IndexList& found) {
  const std::size_t top = blocks.level_count() - 1;
  const std::size_t most = blocks.level(0).stride;
  groups.room_for(most);
  found.count = kernels::filter().meeting(rows_of(blocks.level(top)), nullptr, groups_in(blocks.level(top)),
                                          box, found.room_for(most));
  for (std::size_t level = top; level-- > 0;) {
    std::swap(groups, found);
    found.count = kernels::filter().meeting(rows_of(blocks.level(level)), groups.room.data(), groups.count,
                                            box, found.room.data());
  }
}

/// Boxes put side by side, those of some places.
void gather_boxes(const kernels::Block& from, std::span<const std::uint32_t> places, BoxRows& boxes) {
  boxes.stride = (places.size() + group_size - 1) / group_size * group_size;
  if (boxes.rows.size() < 6 * boxes.stride) boxes.rows.resize(6 * boxes.stride);
  for (std::size_t row = 0; row < 6; ++row) {
    float* const to = boxes.rows.data() + row * boxes.stride;
    const float* const of_row = from.data + row * from.stride;
    for (std::size_t i = 0; i < places.size(); ++i) to[i] = of_row[places[i]];
    std::fill(to + places.size(), to + boxes.stride, std::numeric_limits<float>::quiet_NaN());
  }
}

/// Lists which of such boxes meet another one, by their places.
void find_meeting(const BoxRows& boxes, const kernels::BoxInFrame& box, IndexList& found) {
  found.count = kernels::filter().meeting(rows_of(boxes), nullptr, boxes.stride / group_size, box,
                                          found.room_for(boxes.stride));
}

/// The box of some blocks about their origin.
kernels::BoxInFrame around_all(const VertexBlocks& blocks, std::span<const std::uint32_t> listed) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const VertexBlocks::Level boxes = blocks.level(0);
  std::array<float, 3> low{infinity, infinity, infinity};
  std::array<float, 3> high{-infinity, -infinity, -infinity};
  for (const std::uint32_t block : listed)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], boxes.rows[axis * boxes.stride + block]);
      high[axis] = std::max(high[axis], boxes.rows[(axis + 3) * boxes.stride + block]);
    }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

kernels::BoxInFrame in_frame(const std::array<float, 6>& box) {
  return {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
}

bool meet(const std::array<float, 6>& box, const kernels::BoxInFrame& other) {
  bool all = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
    all = all && box[axis] <= other.max[axis] && box[axis + 3] >= other.min[axis];
  return all;
}

/// At most how far a box is from one that was moved to be beside it.
double lower_distance(const std::array<float, 6>& box, const kernels::BoxInFrame& other) {
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0F, box[axis] - other.max[axis], other.min[axis] - box[axis + 3]});
    squared += gap * gap;
  }
  return std::sqrt(squared) * (1 - double{margin});
}

/// At least the square of what two points are apart whose squared distance in Number is not above it.
template <typename Number>
Number squared_reach(double limit) {
  return static_cast<Number>(limit * limit * (1 + 8 * double{std::numeric_limits<Number>::epsilon()}) +
                             double{std::numeric_limits<Number>::min()});
}

bool are_floats(const SurfacePair& pair) {
  return !pair.a.positions().is_double() && !pair.b.positions().is_double();
}

/// Whether squares of what is about as near as a limit are ordinary floats.
bool suits_float(double limit) {
  return limit > 0x1p-50 && limit < 0x1p50;
}

/// More than a distance, so that what is that far is looked for too.
double above(double distance) {
  return std::nextafter(distance * round_up, std::numeric_limits<double>::infinity());
}

constexpr std::size_t numbers_of_block = 3 * block_size;

/// A block's points, in another precision if need be.
template <typename Number>
void lay_out_block(const Surface& surface, std::uint32_t block, Number* numbers) {
  const PositionView positions = surface.positions();
  const auto vertices = surface.blocks().vertices(block);
  const auto in_own = [&]<typename Own>(Own* own) {
    passes_for<Own>().lay_out_block(points_of<Own>(positions), vertices.data(), vertices.size(), own);
  };
  if constexpr (std::is_same_v<Number, double>) {
    if (!positions.is_double()) {
      std::array<float, numbers_of_block> floats;
      in_own(floats.data());
      std::copy(floats.begin(), floats.end(), numbers);
      return;
    }
  }
  in_own(numbers);
}

}  // namespace

NearVertices::NearVertices(const SurfacePair& pair, double limit, NearBlocks& near,
                           NearVerticesScratch& scratch)
    : pair_(pair),
      of_a_(pair.a.blocks()),
      of_b_(pair.b.blocks()),
      limit_(limit),
      // Floats are compared as floats: their differences lose nothing that matters.
      in_float_(are_floats(pair) && suits_float(limit)),
      near_(near),
      scratch_(scratch) {}

void NearVertices::look_within(double limit) {
  limit_ = limit;
  near_.reach = as_float(limit);
}

void NearVertices::find_blocks() {
  validate_blocks(pair_.a);
  validate_blocks(pair_.b);
  near_.a.count = near_.b.count = 0;
  if (!(limit_ > 0)) return;
  look_within(limit_);
  near_.shift = (of_a_.origin() - of_b_.origin()).cast<float>();
  find_meeting(of_a_, box_about(of_a_, pair_.b.box(), near_.reach), scratch_.groups, near_.a);
  if (near_.a.count == 0) return;
  find_meeting(of_b_, moved(around_all(of_a_, near_.a.listed()), near_.shift, near_.reach), scratch_.groups,
               near_.b);
  near_.few = near_.b.count <= few_blocks;
  if (near_.few) tighten();
  if (near_.a.count > 0) lay_out_blocks_of_b();
}

/// Those of a that are not near all of b's few together go, and the boxes of these are put side by side.
void NearVertices::tighten() {
  const kernels::BoxInFrame box = moved(around_all(of_b_, near_.b.listed()), -near_.shift, near_.reach);
  std::size_t kept = 0;
  for (const std::uint32_t block : near_.a.listed()) {
    near_.a.room[kept] = block;
    kept += meet(of_a_.box(block), box) ? 1U : 0U;
  }
  near_.a.count = kept;
  if (kept > 0) gather_boxes(rows_of(of_b_.level(0)), near_.b.listed(), near_.boxes);
}

void NearVertices::lay_out_blocks_of_b() {
  const auto lay_out = [&]<typename Number>(std::vector<Number>& blocks) {
    const std::size_t count = near_.few ? near_.b.count : of_b_.level(0).count;
    if (blocks.size() < count * numbers_of_block) blocks.resize(count * numbers_of_block);
    for (std::size_t i = 0; i < near_.b.count; ++i) {
      const std::size_t place = near_.few ? i : near_.b.room[i];
      lay_out_block(pair_.b, near_.b.room[i], &blocks[place * numbers_of_block]);
    }
  };
  in_float_ ? lay_out(near_.floats) : lay_out(near_.doubles);
}

template <typename Visit>
void NearVertices::for_each_near(std::uint32_t block_of_a, const Visit& visit) {
  const auto beside = scratch_.beside.listed();
  const auto vertices_a = of_a_.vertices(block_of_a);
  for (std::size_t first = 0; first < beside.size(); first += blocks_at_once) {
    const auto some = beside.subspan(first, std::min(blocks_at_once, beside.size() - first));
    const std::size_t found =
        in_float_ ? compare(block_of_a, some, near_.floats) : compare(block_of_a, some, near_.doubles);
    pair_.count.discarded_in_float += vertices_a.size() * block_size * some.size() - found;
    for (std::size_t i = 0; i < found; ++i) {
      const std::uint32_t near_b = scratch_.near_b.room[i];
      const std::uint32_t place = some[near_b / block_size];
      const auto vertices_b = of_b_.vertices(near_.few ? near_.b.room[place] : place);
      visit(ContactName::of(vertex_piece(vertices_a[scratch_.near_a.room[i]]),
                            vertex_piece(vertices_b[near_b % block_size])));
    }
  }
}

bool NearVertices::name(std::size_t begin, std::size_t end, WorkMeter& meter,
                        std::vector<ContactName>& names) {
  const auto listed = near_.a.listed();
  const bool are_many = !near_.few || near_.boxes.stride > few_at_once;
  while (begin < end) {
    std::size_t next = begin + 1;
    while (next < end && listed[next] / group_size == listed[begin] / group_size) ++next;
    const bool is_run =
        are_many && next - begin >= least_run && find_around(listed.subspan(begin, next - begin));
    for (; begin < next; ++begin) {
      if (!meter.spend()) return false;
      is_run ? find_beside_in_around(listed[begin]) : find_beside(listed[begin]);
      for_each_near(listed[begin], [&](const ContactName& name) {
        if (is_closer_than(pair_, name, limit_)) names.push_back(name);
      });
    }
  }
  return true;
}

bool NearVertices::offer(WorkMeter& meter, ClosestRange& nearest) {
  const double most = limit_;
  nearest.left_out(most);
  order_near_first();
  auto& near_first = scratch_.near_first;
  while (!near_first.empty()) {
    std::pop_heap(near_first.begin(), near_first.end(), std::greater<>());
    const double lower = near_first.back().first;
    const std::uint32_t block = near_first.back().second;
    near_first.pop_back();
    if (!nearest.keep(lower)) break;  // and none of the rest
    if (!meter.spend()) return false;
    look_within(std::min(most, above(nearest.limit())));
    find_beside(block);
    for_each_near(block, [&](const ContactName& name) {
      const SquaredRange squared =
          squared_range(pair_.a.position(name.a().feature.index), pair_.b.position(name.b().feature.index));
      if (!squared.is_beyond(nearest.upper())) nearest.offer(name);
    });
    nearest.left_out(limit_);
  }
  return true;
}

/// A heap of the blocks of a, by how far they are at least from all of b's.
void NearVertices::order_near_first() {
  auto& near_first = scratch_.near_first;
  near_first.clear();
  near_first.reserve(of_a_.level(0).count);
  const kernels::BoxInFrame box = moved(around_all(of_b_, near_.b.listed()), -near_.shift, 0);
  for (const std::uint32_t block : near_.a.listed())
    near_first.emplace_back(lower_distance(of_a_.box(block), box), block);
  std::make_heap(near_first.begin(), near_first.end(), std::greater<>());
}

kernels::BoxInFrame NearVertices::box_around(std::uint32_t block_of_a) const {
  return moved(in_frame(of_a_.box(block_of_a)), near_.shift, near_.reach);
}

/// The blocks of b whose boxes are near some blocks of a together; false where they are too many to be of
/// use.
bool NearVertices::find_around(std::span<const std::uint32_t> blocks_of_a) {
  const kernels::BoxInFrame box = moved(around_all(of_a_, blocks_of_a), near_.shift, near_.reach);
  if (near_.few)
    find_meeting(near_.boxes, box, scratch_.around);
  else
    find_meeting(of_b_, box, scratch_.groups, scratch_.around);
  const auto around = scratch_.around.listed();
  if (around.size() > few_at_once) return false;
  gather_boxes(near_.few ? rows_of(near_.boxes) : rows_of(of_b_.level(0)), around, scratch_.boxes);
  return true;
}

/// The blocks of b whose boxes are near one of a.
void NearVertices::find_beside(std::uint32_t block_of_a) {
  if (near_.few)
    find_meeting(near_.boxes, box_around(block_of_a), scratch_.beside);
  else
    find_meeting(of_b_, box_around(block_of_a), scratch_.groups, scratch_.beside);
}

/// The same of one of those that were asked about together.
void NearVertices::find_beside_in_around(std::uint32_t block_of_a) {
  IndexList& found = scratch_.beside;
  find_meeting(scratch_.boxes, box_around(block_of_a), found);
  for (std::size_t i = 0; i < found.count; ++i) found.room[i] = scratch_.around.room[found.room[i]];
}

template <typename Number>
std::size_t NearVertices::compare(std::uint32_t block_of_a, std::span<const std::uint32_t> beside,
                                  const std::vector<Number>& blocks_of_b) {
  std::array<Number, numbers_of_block> block;
  lay_out_block(pair_.a, block_of_a, block.data());
  const std::size_t most = block_size * block_size * beside.size();
  return passes_for<Number>().near_points(block.data(), of_a_.vertices(block_of_a).size(), blocks_of_b.data(),
                                          beside.data(), beside.size(), squared_reach<Number>(limit_),
                                          {scratch_.near_a.room_for(most), scratch_.near_b.room_for(most)});
}

void NearBlocks::reserve(const PairRoom& room) {
  const std::size_t blocks = room.vertices / block_size + 1;
  a.reserve(blocks + group_size);
  b.reserve(blocks + group_size);
  boxes.reserve(few_blocks);
  floats.resize(std::max(floats.size(), blocks * numbers_of_block));
  doubles.resize(std::max(doubles.size(), blocks * numbers_of_block));
}

void NearVerticesScratch::reserve(const PairRoom& room) {
  const std::size_t found = room.vertices / block_size + 1 + group_size;
  for (IndexList* const list : {&groups, &around, &beside}) list->reserve(found);
  boxes.reserve(found);
  near_first.reserve(found);
  for (IndexList* const near : {&near_a, &near_b}) near->reserve(block_size * block_size * blocks_at_once);
}

}  // namespace graze
