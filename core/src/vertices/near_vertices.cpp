#include "vertices/near_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "core/mesh/pair_room.hpp"
#include "surface/passes_for.hpp"
#include "surface/validate_surface.hpp"

namespace graze {
namespace {

constexpr std::size_t block_size = VertexBlocks::block_size;
constexpr std::size_t group_size = VertexBlocks::group_size;

/// Up to so many blocks of b are tested in a line beside each block of a. More are tested by their levels.
constexpr std::size_t most_blocks_to_scan = 8 * group_size;
/// Up to so many boxes of b are tested for a block of a as quickly as they are sorted out for several blocks
/// before.
constexpr std::size_t most_boxes_at_once = 4 * group_size;
/// The least number of blocks of a in one group of sixteen that are worth it.
constexpr std::size_t least_run = 4;
/// Up to so many blocks of b have too few pairs within the limit to find the nearest first.
constexpr std::size_t most_blocks_beside = 4;
/// How many pairs of points are visited between two checks of the clock.
constexpr std::size_t visited_each = 256;
/// Blocks of b whose points are compared at once.
constexpr std::size_t blocks_at_once = 128;

float as_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return value > most ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
}

/// The largest squared distance, as computed in Number, of two points within a limit.
template <typename Number>
Number squared_reach(double limit) {
  return static_cast<Number>(limit * limit * (1 + 8 * double{std::numeric_limits<Number>::epsilon()}) +
                             double{std::numeric_limits<Number>::min()});
}

bool are_floats(const SurfacePair& pair) {
  return !pair.a.positions().is_double() && !pair.b.positions().is_double();
}

/// Whether squares of distances near a limit are ordinary floats.
bool suits_float(double limit) {
  return limit > 0x1p-50 && limit < 0x1p50;
}

/// Slightly more than a distance, so that a search includes points that far apart.
double above(double distance) {
  return std::nextafter(distance * round_up, std::numeric_limits<double>::infinity());
}

constexpr std::size_t numbers_of_block = 3 * block_size;

/// A block's points, in another precision if need be.
template <typename Number>
void lay_out_block(const PositionView& positions, std::span<const std::uint32_t> vertices, Number* numbers) {
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
      of_a_(pair.a.has_blocks() ? pair.a.blocks() : near.part_a.blocks),
      of_b_(pair.b.has_blocks() ? pair.b.blocks() : near.part_b.blocks),
      limit_(limit),
      // Floats are compared as floats: their differences lose nothing that matters.
      in_float_(are_floats(pair) && suits_float(limit)),
      near_(near),
      scratch_(scratch) {}

void NearVertices::set_limit(double limit) {
  limit_ = limit;
  near_.reach = as_float(limit);
}

void NearVertices::find_blocks() {
  near_.a.count = near_.b.count = 0;
  if (!(limit_ > 0)) return;
  set_limit(limit_);
  if (!make_parts()) return;
  validate_blocks(pair_.a, of_a_);
  validate_blocks(pair_.b, of_b_);
  near_.shift = (of_a_.origin() - of_b_.origin()).cast<float>();
  find_meeting(of_a_, box_about(of_a_.origin(), pair_.b.box(), near_.reach), scratch_.groups, near_.a);
  if (near_.a.count == 0) return;
  find_meeting(of_b_, moved(around_all(of_a_, near_.a.listed()), near_.shift, near_.reach), scratch_.groups,
               near_.b);
  near_.is_linear_scan = near_.b.count <= most_blocks_to_scan;
  if (near_.is_linear_scan) tighten();
  if (near_.a.count > 0) lay_out_blocks_of_b();
}

/// Makes blocks of the part of each surface in the other's box, where it has no blocks of all. Returns false
/// where it has nothing there.
bool NearVertices::make_parts() {
  const auto make = [&](const Surface& surface, const Surface& other, NearPart& part) {
    if (surface.has_blocks()) return true;
    make_near_part(surface, other.box(), near_.reach, part);
    return !part.order.empty();
  };
  return make(pair_.a, pair_.b, near_.part_a) && make(pair_.b, pair_.a, near_.part_b);
}

/// Keeps the blocks of a that are near all listed blocks of b together, which are few, and puts their boxes
/// side by side.
void NearVertices::tighten() {
  find_meeting(of_a_, moved(around_all(of_b_, near_.b.listed()), -near_.shift, near_.reach), scratch_.groups,
               near_.a);
  if (near_.a.count > 0) gather_boxes(rows_of(of_b_.level(0)), near_.b.listed(), near_.boxes);
}

void NearVertices::lay_out_blocks_of_b() {
  const auto lay_out = [&]<typename Number>(std::vector<Number>& blocks) {
    const std::size_t count = near_.is_linear_scan ? near_.b.count : of_b_.level(0).count;
    if (blocks.size() < count * numbers_of_block) blocks.resize(count * numbers_of_block);
    for (std::size_t i = 0; i < near_.b.count; ++i) {
      const std::size_t slot = near_.is_linear_scan ? i : near_.b.room[i];
      lay_out_block(pair_.b.positions(), of_b_.vertices(near_.b.room[i]), &blocks[slot * numbers_of_block]);
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
      if (i % visited_each == 0) pair_.check_time(visited_each / 8);
      const std::uint32_t near_b = scratch_.near_b.room[i];
      const std::uint32_t slot = some[near_b / block_size];
      const auto vertices_b = of_b_.vertices(near_.is_linear_scan ? near_.b.room[slot] : slot);
      const std::uint32_t of_a = vertices_a[scratch_.near_a.room[i]];
      const std::uint32_t of_b = vertices_b[near_b % block_size];
      if (pair_.may_vertices(of_a, of_b)) visit(FeaturePairKey::of(vertex_piece(of_a), vertex_piece(of_b)));
    }
  }
}

bool NearVertices::append_near(std::size_t begin, std::size_t end, double threshold, WorkMeter& meter,
                               std::vector<FeaturePairKey>& keys, const NearListing& listing) {
  const auto listed = near_.a.listed();
  const bool are_many = !near_.is_linear_scan || near_.boxes.stride > most_boxes_at_once;
  while (begin < end) {
    std::size_t next = begin + 1;
    while (next < end && listed[next] / group_size == listed[begin] / group_size) ++next;
    const bool is_run =
        are_many && next - begin >= least_run && find_around(listed.subspan(begin, next - begin));
    for (; begin < next; ++begin) {
      if (!meter.spend()) return false;
      is_run ? find_beside_in_around(listed[begin]) : find_beside(listed[begin]);
      for_each_near(listed[begin], [&](const FeaturePairKey& key) {
        listing.add({FeatureRefKind::vertex, key.index_a()}, {FeatureRefKind::vertex, key.index_b()});
        if (is_closer_than(pair_, key, threshold)) keys.push_back(key);
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
  for (bool is_first = true; !near_first.empty(); is_first = false) {
    std::pop_heap(near_first.begin(), near_first.end(), std::greater<>());
    const double lower = near_first.back().first;
    const std::uint32_t block = near_first.back().second;
    near_first.pop_back();
    if (!nearest.keep(lower)) break;  // and none of the rest
    if (!meter.spend()) return false;
    set_limit(std::min(most, above(nearest.limit())));
    find_beside(block);
    const bool may_all = pair_.groups == nullptr;
    if (may_all && is_first && scratch_.beside.count > most_blocks_beside)
      set_limit(std::min(limit_, in_float_ ? upper_distance_beside(block, near_.floats)
                                           : upper_distance_beside(block, near_.doubles)));
    for_each_near(block, [&](const FeaturePairKey& key) {
      const SquaredRange squared =
          squared_range(pair_.a.position(key.a().feature.index), pair_.b.position(key.b().feature.index));
      if (!squared.is_beyond(nearest.upper())) nearest.offer(key);
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

/// The blocks of b whose boxes are near some blocks of a together. Returns false where they are too many to
/// be of use.
bool NearVertices::find_around(std::span<const std::uint32_t> blocks_of_a) {
  const kernels::BoxInFrame box = moved(around_all(of_a_, blocks_of_a), near_.shift, near_.reach);
  if (near_.is_linear_scan)
    find_meeting(near_.boxes, box, scratch_.around);
  else
    find_meeting(of_b_, box, scratch_.groups, scratch_.around);
  const auto around = scratch_.around.listed();
  if (around.size() > most_boxes_at_once) return false;
  gather_boxes(near_.is_linear_scan ? rows_of(near_.boxes) : rows_of(of_b_.level(0)), around, scratch_.boxes);
  return true;
}

/// The blocks of b whose boxes are near one of a.
void NearVertices::find_beside(std::uint32_t block_of_a) {
  if (near_.is_linear_scan)
    find_meeting(near_.boxes, box_around(block_of_a), scratch_.beside);
  else
    find_meeting(of_b_, box_around(block_of_a), scratch_.groups, scratch_.beside);
}

/// Finds the blocks of b near one block of a, among those found for several blocks together.
void NearVertices::find_beside_in_around(std::uint32_t block_of_a) {
  IndexList& found = scratch_.beside;
  find_meeting(scratch_.boxes, box_around(block_of_a), found);
  for (std::size_t i = 0; i < found.count; ++i) found.room[i] = scratch_.around.room[found.room[i]];
}

/// At least the distance of the nearest points of a block and those found beside it.
template <typename Number>
double NearVertices::upper_distance_beside(std::uint32_t block_of_a,
                                           const std::vector<Number>& blocks_of_b) const {
  std::array<Number, numbers_of_block> block;
  lay_out_block(pair_.a.positions(), of_a_.vertices(block_of_a), block.data());
  const auto beside = scratch_.beside.listed();
  const Number squared = passes_for<Number>().least_squared(block.data(), of_a_.vertices(block_of_a).size(),
                                                            blocks_of_b.data(), beside.data(), beside.size());
  return above(std::sqrt(double{squared} * (1 + 8 * double{std::numeric_limits<Number>::epsilon()}) +
                         double{std::numeric_limits<Number>::min()}));
}

template <typename Number>
std::size_t NearVertices::compare(std::uint32_t block_of_a, std::span<const std::uint32_t> beside,
                                  const std::vector<Number>& blocks_of_b) {
  std::array<Number, numbers_of_block> block;
  lay_out_block(pair_.a.positions(), of_a_.vertices(block_of_a), block.data());
  const std::size_t most = block_size * block_size * beside.size();
  return passes_for<Number>().near_points(block.data(), of_a_.vertices(block_of_a).size(), blocks_of_b.data(),
                                          beside.data(), beside.size(), squared_reach<Number>(limit_),
                                          {scratch_.near_a.room_for(most), scratch_.near_b.room_for(most)});
}

void NearBlocks::reserve(const PairRoom& room) {
  part_a.reserve(room);
  part_b.reserve(room);
  const std::size_t blocks = room.vertices / block_size + 1;
  a.reserve(blocks + group_size);
  b.reserve(blocks + group_size);
  boxes.reserve(most_blocks_to_scan);
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
