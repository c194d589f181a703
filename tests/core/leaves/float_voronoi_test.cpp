// This test compares every Voronoi region that the float kernels give with rational arithmetic, on the
// coordinates that the frame was made from. If float is certain where the closest points lie, they must lie
// there.

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/answers/nearest_voronoi.hpp"
#include "core/leaves/filter_families.hpp"
#include "leaves/layout/float_filter.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using oracle::Rational;

constexpr float everything = 0x1p60F;  // what all pairs are nearer than

/// Pairs of features: the first of `a` and the first of `b`, and so on.
template <std::size_t CornersA, std::size_t CornersB>
struct Pairs {
  std::vector<Corner<CornersA>> a;
  std::vector<Corner<CornersB>> b;

  [[nodiscard]] FilterFrame frame() const { return {box_of_all(a), box_of_all(b)}; }

 private:
  template <typename Features>
  static Box box_of_all(const Features& features) {
    Box box;
    for (const auto& corners : features)
      for (const Vector3d& corner : corners) box.add(corner);
    return box;
  }
};
using PointsAndTriangles = Pairs<1, 3>;
using TwoSegments = Pairs<2, 2>;
using SegmentsAndTriangles = Pairs<2, 3>;

/// Returns the answer of a float kernel for each pair, and nothing for each pair that it discards.
template <std::size_t CornersA, std::size_t CornersB, typename Ask>
std::vector<std::optional<KnownInFloat>> known_of(const Pairs<CornersA, CornersB>& pairs,
                                                  const FilterFrame& frame, const Ask& ask) {
  const auto a = block_of(pairs.a, frame);
  const auto b = block_of(pairs.b, frame);
  std::vector<std::optional<KnownInFloat>> known(a.count());
  FloatBatch<CornersA, CornersB> batch;
  const auto empty = [&] {
    batch.empty(ask, [&](const FeatureRef& of_a, const FeatureRef& /*of_b*/, const KnownInFloat& found) {
      known[of_a.index] = found;
    });
  };
  std::vector<std::uint32_t> numbers(known.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  batch.add(a.view(), numbers.data(), b.view(), numbers.data(), numbers.size(), empty);
  empty();
  return known;
}
auto known_of(const PointsAndTriangles& pairs, const FilterFrame& frame, const kernels::NearLimits& limits) {
  const auto kernel = kernels::filter().bound_points_and_triangles;
  return known_of(pairs, frame, [&](auto& batch) { return kernel(batch, limits); });
}
auto known_of(const TwoSegments& pairs, const FilterFrame& frame, const kernels::NearLimits& limits) {
  const auto kernel = kernels::filter().bound_segments;
  return known_of(pairs, frame, [&](auto& batch) { return kernel(batch, limits); });
}

/// The exact answer for a pair: the Voronoi region of its closest points, whether they lie only there, and
/// their squared distance in the frame.
struct Truth {
  std::int32_t voronoi = 0;
  bool is_unique = true;  ///< not of a triangle without area, whose sides lie upon each other
  Rational squared_distance;

  [[nodiscard]] bool is_nearer(float below) const {
    return below > 0 && squared_distance < Rational(below) * Rational(below);
  }
};
Truth truth_of(const Corner<1>& point, const Corner<3>& triangle) {
  const ExactCorners<3> c = exact_corners(triangle);
  const NearestInTriangle nearest = nearest_in_triangle(oracle::exact(point[0]), c);
  const bool has_area = !is_zero(cross(c[1] - c[0], c[2] - c[0]));
  return {static_cast<std::int32_t>(nearest.voronoi), has_area, nearest.squared_distance};
}
std::int32_t voronoi_of(Along a, Along b) {
  return 4 * static_cast<std::int32_t>(a) + static_cast<std::int32_t>(b);
}
Truth truth_of(const Corner<2>& a, const Corner<2>& b) {
  const NearestOfSegments nearest = nearest_of_segments(exact_corners(a), exact_corners(b));
  return {voronoi_of(nearest.along[0], nearest.along[1]), nearest.is_unique, nearest.squared_distance};
}
template <std::size_t CornersA, std::size_t CornersB>
std::vector<Truth> truths_of(const Pairs<CornersA, CornersB>& pairs, const FilterFrame& frame) {
  std::vector<Truth> truths;
  const Rational scale(frame.scale());
  for (std::size_t i = 0; i < pairs.a.size(); ++i) {
    truths.push_back(truth_of(pairs.a[i], pairs.b[i]));
    truths.back().squared_distance *= scale * scale;
  }
  return truths;
}

/// The largest magnitude of a feature's coordinates in a frame.
template <std::size_t Corners>
double size_in(const FilterFrame& frame, const Corner<Corners>& corners) {
  double size = 0;
  for (const Vector3d& corner : corners) size = std::max(size, frame.to_local(corner).cwiseAbs().maxCoeff());
  return size;
}

/// How many pairs were left and nearer than asked for, and how many of these float was certain of.
struct VoronoiTally {
  std::size_t near = 0;
  std::size_t certain = 0;
  std::array<std::size_t, 11> places{};

  void add(bool is_nearer, std::int32_t voronoi) {
    near += is_nearer ? 1 : 0;
    if (voronoi == kernels::unsure_voronoi) return;
    ++certain;
    ++places[static_cast<std::size_t>(voronoi)];
  }
  void add(const VoronoiTally& other) {
    near += other.near;
    certain += other.certain;
    for (std::size_t voronoi = 0; voronoi < places.size(); ++voronoi)
      places[voronoi] += other.places[voronoi];
  }
};

/// Checks one answer of a float kernel. It must be either unsure, or the true Voronoi region of a pair that
/// is nearer than `below`.
void check_voronoi(std::int32_t voronoi, const Truth& truth, float below) {
  if (voronoi == kernels::unsure_voronoi) return;
  REQUIRE(truth.is_nearer(below));
  REQUIRE(truth.is_unique);
  REQUIRE(voronoi == truth.voronoi);
}

/// Asks for the places of all pairs nearer than some distances.
template <typename AnyPairs>
void check_voronois(const AnyPairs& pairs, VoronoiTally& tally) {
  const FilterFrame frame = pairs.frame();
  const std::vector<Truth> truths = truths_of(pairs, frame);
  for (const float below : {everything, 1.0F, 0.3F}) {
    const auto known = known_of(pairs, frame, {below, below});
    for (std::size_t i = 0; i < truths.size(); ++i) {
      INFO("pair " << i << ", below " << below);
      const bool is_nearer = truths[i].is_nearer(below);
      if (is_nearer) REQUIRE((known[i] && known[i]->is_bounded));
      if (!known[i]) continue;
      check_voronoi(known[i]->voronoi, truths[i], below);
      tally.add(is_nearer, known[i]->voronoi);
    }
  }
}

/// Asks for the place of each pair that is certain at just its distance and a little closer and further.
/// `late` further, float is certain again.
template <typename AnyPairs>
void check_distances(const AnyPairs& pairs, VoronoiTally& tally) {
  const FilterFrame frame = pairs.frame();
  const std::vector<Truth> truths = truths_of(pairs, frame);
  const auto known = known_of(pairs, frame, {infinity, everything});
  for (std::size_t i = 0; i < truths.size(); ++i) {
    INFO("pair " << i);
    REQUIRE(known[i].has_value());
    if (known[i]->voronoi == kernels::unsure_voronoi) continue;
    const double distance = oracle::round_sqrt(truths[i].squared_distance);
    const double sizes = size_in(frame, pairs.a[i]) + size_in(frame, pairs.b[i]);
    const double late = 24 * double{kernels::error_of_difference} * sizes;
    for (const double share : {-0.01, 0.0, 0.01, 0.1, 1.0}) {
      const auto below = static_cast<float>(distance + share * late);
      const auto voronoi =
          known_of(AnyPairs{{pairs.a[i]}, {pairs.b[i]}}, frame, {infinity, below})[0]->voronoi;
      check_voronoi(voronoi, truths[i], below);
      if (share == 1.0) REQUIRE(voronoi == truths[i].voronoi);
      tally.add(truths[i].is_nearer(below), voronoi);
    }
  }
}

/// Asks whether segments pass triangles. Also counts those that certainly do, and that certainly do not.
struct PassingTally {
  std::size_t asked = 0;
  std::size_t through = 0;
  std::size_t beside = 0;

  void add(const PassingTally& other) {
    asked += other.asked;
    through += other.through;
    beside += other.beside;
  }
};
void check_passing(const SegmentsAndTriangles& pairs, PassingTally& tally) {
  const auto known = known_of(pairs, pairs.frame(), kernels::filter().passing);
  for (std::size_t i = 0; i < known.size(); ++i) {
    INFO("pair " << i);
    ++tally.asked;
    if (known[i] && known[i]->voronoi == kernels::unsure_voronoi) continue;
    const Crossing crossing = crossing_of(exact_corners(pairs.a[i]), exact_corners(pairs.b[i]));
    if (known[i]) {
      REQUIRE(known[i]->voronoi == kernels::passes_through);
      REQUIRE(crossing == Crossing::inside);
      ++tally.through;
    } else {
      // A quad may be passed through between its triangles.
      REQUIRE((crossing == Crossing::none || crossing == Crossing::beside));
      ++tally.beside;
    }
  }
}

/// None is missing among those that float was certain of.
void check_all_voronois(const std::array<VoronoiTally, 2>& of_points_and_segments) {
  for (std::size_t voronoi = 0; voronoi <= static_cast<std::size_t>(VoronoiRegion::inside); ++voronoi)
    CHECK(of_points_and_segments[0].places[voronoi] > 60);
  for (const Along a : {Along::first, Along::second, Along::inside})
    for (const Along b : {Along::first, Along::second, Along::inside})
      CHECK(of_points_and_segments[1].places[static_cast<std::size_t>(voronoi_of(a, b))] > 60);
}

std::size_t percent(std::size_t part, std::size_t all) {
  return part * 100 / all;
}

// ---- Features of any shape

/// Makes two leaves that overlap, with `count` features of each kind.
std::pair<Batch, Batch> leaves_of(std::size_t family, std::uint64_t seed, std::size_t count) {
  Generator generator(static_cast<Family>(family), seed);
  const Batch a = generator.batch(Vector3d::Zero(), count);
  return {a, generator.batch(beside_of(seed) / 4, count)};
}

/// On a grid and of degenerate features many questions have the answer zero, needles are thinner than the
/// errors, and the tiny ones are as small as these.
std::size_t least_percent(std::size_t family) {
  switch (static_cast<Family>(family)) {
    case Family::grid:
    case Family::degenerate:
      return 45;
    case Family::needles:
      return 0;
    case Family::tiny_and_large:
      return 20;
    default:
      return 90;
  }
}

// ---- Features whose closest points are where one place ends

/// Pairs of features whose closest points are just where one place ends and another begins, but for about as
/// much as float is off. On a grid they are exactly there.
class Borders {
 public:
  Borders(bool is_on_grid, std::uint64_t seed) : is_on_grid_(is_on_grid), random_(seed) {}

  PointsAndTriangles points_and_triangles(std::size_t count) {
    return make<1, 3>(count, [&] { return point_and_triangle(); });
  }
  TwoSegments segments(std::size_t count) {
    return make<2, 2>(count, [&] { return two_segments(); });
  }
  SegmentsAndTriangles segments_and_triangles(std::size_t count) {
    return make<2, 3>(count, [&] { return segment_and_triangle(); });
  }

 private:
  template <std::size_t CornersA, std::size_t CornersB, typename Pair>
  Pairs<CornersA, CornersB> make(std::size_t count, const Pair& pair) {
    Pairs<CornersA, CornersB> pairs;
    for (std::size_t i = 0; i < count; ++i) {
      auto [a, b] = pair();
      move(a, b);
      pairs.a.push_back(a);
      pairs.b.push_back(b);
    }
    return pairs;
  }

  /// Straight above a corner or the middle of a side, or from a corner at a right angle to a side.
  std::pair<Corner<1>, Corner<3>> point_and_triangle() {
    const Corner<3> corner{vector(), vector(), vector()};
    const std::size_t i = random_.below(3);
    const Vector3d side = corner[(i + 1) % 3] - corner[i];
    const Vector3d normal = side.cross(corner[(i + 2) % 3] - corner[i]);
    const Vector3d above = corner[i] + normal * number();
    if (random_.chance(0.3)) return {{above + side / 2}, corner};
    return {{above + normal.cross(side) * (random_.chance(0.5) ? number() : 0)}, corner};
  }

  /// Parallel, or with a way between ends or middles at a right angle to one or both.
  std::pair<Corner<2>, Corner<2>> two_segments() {
    const Vector3d u = vector();
    const Vector3d v = random_.chance(0.3) ? u * number() : vector();
    const Vector3d way = random_.chance(0.5) ? u.cross(v) * number() : v.cross(vector());
    const Vector3d first = vector();
    const std::array along{0.5 * random_.below(3), 0.5 * random_.below(3)};
    const Vector3d other = first + u * along[0] + way - v * along[1];
    return {{first, first + u}, {other, other + v}};
  }

  /// Through a corner, a side or the inside, to there or beyond.
  std::pair<Corner<2>, Corner<3>> segment_and_triangle() {
    const Corner<3> corner{vector(), vector(), vector()};
    const std::size_t i = random_.below(3);
    Vector3d point = corner[i];
    if (random_.chance(0.7)) point = (point + corner[(i + 1) % 3]) / 2;
    if (random_.chance(0.3)) point = (point + corner[(i + 2) % 3]) / 2;
    const Vector3d along = vector();
    return {{point + along, random_.chance(0.3) ? point : point - along}, corner};
  }

  /// Not in the middle of the frame, where coordinates are hardly rounded.
  template <std::size_t CornersA, std::size_t CornersB>
  void move(Corner<CornersA>& a, Corner<CornersB>& b) {
    const Vector3d by = vector() * std::ldexp(1.0, static_cast<int>(random_.below(8)));
    const double off =
        is_on_grid_ ? 0 : by.norm() * std::ldexp(1.0, -12 - static_cast<int>(random_.below(15)));
    for (Vector3d& corner : a) corner += by + vector() * off;
    for (Vector3d& corner : b) corner += by + vector() * off;
  }

  double number() { return is_on_grid_ ? static_cast<double>(random_.below(5)) - 2 : random_.between(-2, 2); }
  Vector3d vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  bool is_on_grid_;
  Random random_;
};

}  // namespace

TEST_CASE(
    "float Voronoi regions: the error of a difference is more than the analysis of docs/numerics.md needs") {
  // In units of 2^-24 and of a feature's size: of each corner's conversion 1, and 2 for the subtraction of
  // coordinates whose difference is at most twice as large. All that is times the root of 3.
  CHECK((1 + 1 + 2) * std::sqrt(3.0) < double{kernels::error_of_difference} / 0x1p-24);
  CHECK(double{kernels::error_of_difference} / 0x1p-24 >= 7);  // as in the sums that follow from it
}

TEST_CASE("float Voronoi regions: of points and triangles, and of segments, of any shape") {
  std::array<VoronoiTally, 2> all;
  for (std::size_t family = 0; family < family_count; ++family) {
    std::array<VoronoiTally, 2> tallies;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      INFO("family " << family << ", seed " << seed);
      const auto [a, b] = leaves_of(family, seed, 100);
      check_voronois(PointsAndTriangles{a.points, b.triangles}, tallies[0]);
      check_voronois(TwoSegments{a.segments, b.segments}, tallies[1]);
    }
    for (std::size_t i = 0; i < tallies.size(); ++i) {
      INFO("family " << family << ": " << tallies[i].certain << " of " << tallies[i].near);
      CHECK(percent(tallies[i].certain, tallies[i].near) >= least_percent(family));
      all[i].add(tallies[i]);
    }
  }
  check_all_voronois(all);
  std::cout << "compared " << all[0].certain << " Voronoi regions of triangles and " << all[1].certain
            << " of segments from float, of " << all[0].near + all[1].near << " near pairs\n";
}

TEST_CASE("float Voronoi regions: whether segments pass triangles of any shape") {
  PassingTally all;
  for (std::size_t family = 0; family < family_count; ++family) {
    PassingTally tally;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      INFO("family " << family << ", seed " << seed);
      const auto [a, b] = leaves_of(family, seed, 300);
      check_passing({a.segments, b.triangles}, tally);
    }
    INFO("family " << family << ": " << tally.through + tally.beside << " of " << tally.asked);
    CHECK(percent(tally.through + tally.beside, tally.asked) >= least_percent(family));
    all.add(tally);
  }
  CHECK(all.through > 100);
  CHECK(all.beside > 10'000);
  std::cout << "compared " << all.through << " segments that float says pass a triangle, and " << all.beside
            << " that do not, of " << all.asked << "\n";
}

TEST_CASE("float Voronoi regions: where one region ends and another begins") {
  std::array<VoronoiTally, 2> all;
  PassingTally passing;
  for (const bool is_on_grid : {false, true})
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      INFO("on grid " << is_on_grid << ", seed " << seed);
      Borders borders(is_on_grid, seed);
      check_voronois(borders.points_and_triangles(100), all[0]);
      check_voronois(borders.segments(100), all[1]);
      check_passing(borders.segments_and_triangles(100), passing);
    }
  for (const VoronoiTally& tally : all) {
    CHECK(tally.certain > 1000);
    CHECK(tally.certain < tally.near / 2);
  }
  CHECK(passing.through > 100);
  CHECK(passing.beside > 10);
  CHECK(passing.through + passing.beside < passing.asked / 2);
  std::cout << "compared " << all[0].certain + all[1].certain + passing.through + passing.beside
            << " regions and passings where these change, of " << all[0].near + all[1].near + passing.asked
            << "\n";
}

TEST_CASE("float Voronoi regions: nearer than a distance is said not too early, nor much too late") {
  std::array<VoronoiTally, 2> all;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      INFO("family " << family << ", seed " << seed);
      const auto [a, b] = leaves_of(family, seed, 60);
      check_distances(PointsAndTriangles{a.points, b.triangles}, all[0]);
      check_distances(TwoSegments{a.segments, b.segments}, all[1]);
    }
  for (const VoronoiTally& tally : all) {
    CHECK(tally.certain > 500);
    CHECK(tally.certain < tally.near);
  }
  check_all_voronois(all);
  std::cout << "compared " << all[0].certain + all[1].certain << " Voronoi regions at just their distance\n";
}

TEST_CASE("float Voronoi regions: of none where no distance is asked for") {
  const auto [a, b] = leaves_of(0, 3, 100);
  const PointsAndTriangles over{a.points, b.triangles};
  const TwoSegments segments{a.segments, b.segments};
  for (const kernels::NearLimits& limits :
       {kernels::NearLimits{infinity}, {infinity, -1}, {1, 0}, {everything, std::nanf("")}}) {
    for (const auto& known : known_of(over, over.frame(), limits))
      CHECK((!known || known->voronoi == kernels::unsure_voronoi));
    for (const auto& known : known_of(segments, segments.frame(), limits))
      CHECK((!known || known->voronoi == kernels::unsure_voronoi));
  }
}

TEST_CASE("float Voronoi regions: features too large for float are left, and nothing is certain of them") {
  const auto [a, b] = leaves_of(0, 4, 40);
  const FilterFrame frame(a.box, b.box);
  const auto check = [&](auto pairs, const auto& ask) {
    const auto before = ask(pairs);
    for (std::size_t i = 0; i < pairs.a.size(); i += 3)
      (i % 2 == 0 ? pairs.a[i].back() : pairs.b[i].back()) = Vector3d(1e30, 2, 3);
    const auto known = ask(pairs);
    for (std::size_t i = 0; i < pairs.a.size(); ++i) {
      const bool is_too_large = i % 3 == 0;
      if (is_too_large) {
        REQUIRE(known[i].has_value());
        CHECK_FALSE(known[i]->is_bounded);
        CHECK(known[i]->voronoi == kernels::unsure_voronoi);
      } else {
        REQUIRE(known[i].has_value() == before[i].has_value());
        if (known[i]) CHECK((known[i]->is_bounded && known[i]->voronoi == before[i]->voronoi));
      }
    }
  };
  const kernels::NearLimits limits{0.5F, 0.5F};
  const auto near = [&](const auto& pairs) { return known_of(pairs, frame, limits); };
  check(PointsAndTriangles{a.points, b.triangles}, near);
  check(TwoSegments{a.segments, b.segments}, near);
  check(SegmentsAndTriangles{a.segments, b.triangles},
        [&](const auto& pairs) { return known_of(pairs, frame, kernels::filter().passing); });
}

}  // namespace graze::tests
