// Bins ascend as keys do, and putting keys into bins loses none.

#include "closest_features/key_bins.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

FeaturePiece random_piece(oracle::Random& random, const IndexedMesh& mesh) {
  const auto kind = static_cast<FeatureKind>(random.below(3));
  const std::uint32_t count = kind == FeatureKind::vertex ? mesh.vertex_count()
                              : kind == FeatureKind::edge ? mesh.edge_count()
                                                          : mesh.face_count();
  // Now and then the last.
  return {{kind, random.chance(0.1) ? count - 1 : random.below(count)}, static_cast<Piece>(random.below(3))};
}

std::vector<FeaturePairKey> random_keys(oracle::Random& random, const IndexedMesh& mesh,
                                        std::uint32_t count) {
  std::vector<FeaturePairKey> keys;
  for (std::uint32_t i = 0; i < count; ++i) {
    const FeaturePiece a = random_piece(random, mesh);
    const FeaturePiece b = random_piece(random, mesh);
    keys.push_back(FeaturePairKey::of(a, b, static_cast<Meeting>(random.below(3))));
  }
  return keys;
}

}  // namespace

TEST_CASE("key bins: all keys come bin by bin, and bins ascend as keys do") {
  KeyBinning binning;
  std::vector<BinRun> runs;
  // Fewer features than a kind has bins, and many more.
  for (const auto& [around, rings] : {std::pair{3U, 3U}, std::pair{6U, 4U}, std::pair{60U, 40U}}) {
    const Surface surface = surface_of(shape_of(models::torus(around, rings, 0.8, 0.3)));
    const KeyBins bins(surface.mesh());
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      oracle::Random random(seed);
      std::vector<FeaturePairKey> keys =
          random_keys(random, surface.mesh(), seed == 0 ? 0 : random.below(900));
      std::vector<FeaturePairKey> sorted = keys;
      std::sort(sorted.begin(), sorted.end());
      CHECK(std::is_sorted(sorted.begin(), sorted.end(), [&](const auto& left, const auto& right) {
        return bins.of(left) < bins.of(right);
      }));

      binning.put_into(bins, keys, runs);
      std::uint32_t end = 0;
      for (const BinRun& run : runs) {
        REQUIRE(run.begin == end);
        REQUIRE(run.end > run.begin);
        REQUIRE(run.end <= keys.size());
        REQUIRE(run.bin < KeyBins::count);
        end = run.end;
        for (std::uint32_t i = run.begin; i < run.end; ++i) CHECK(bins.of(keys[i]) == run.bin);
        std::sort(keys.begin() + run.begin, keys.begin() + run.end);
      }
      CHECK(end == keys.size());
      CHECK(keys == sorted);
    }
  }
}

}  // namespace graze::tests
