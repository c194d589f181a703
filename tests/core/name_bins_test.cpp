// Bins ascend as names do, and putting names into bins loses none.

#include "names/name_bins.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"

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

std::vector<ContactName> random_names(oracle::Random& random, const IndexedMesh& mesh, std::uint32_t count) {
  std::vector<ContactName> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    const FeaturePiece a = random_piece(random, mesh);
    const FeaturePiece b = random_piece(random, mesh);
    names.push_back(ContactName::of(a, b, static_cast<Meeting>(random.below(3))));
  }
  return names;
}

}  // namespace

TEST_CASE("names in bins: all of them, bin by bin, and bins ascend as names do") {
  NameBinning binning;
  std::vector<BinRun> runs;
  // Fewer features than a kind has bins, and many more.
  for (const auto& [around, rings] : {std::pair{3U, 3U}, std::pair{6U, 4U}, std::pair{60U, 40U}}) {
    const Surface surface = surface_of(shape_of(models::torus(around, rings, 0.8, 0.3)));
    const NameBins bins(surface.mesh());
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      oracle::Random random(seed);
      std::vector<ContactName> names =
          random_names(random, surface.mesh(), seed == 0 ? 0 : random.below(900));
      std::vector<ContactName> sorted = names;
      std::sort(sorted.begin(), sorted.end());
      CHECK(std::is_sorted(sorted.begin(), sorted.end(), [&](const auto& left, const auto& right) {
        return bins.of(left) < bins.of(right);
      }));

      binning.put_into(bins, names, runs);
      std::uint32_t end = 0;
      for (const BinRun& run : runs) {
        REQUIRE(run.begin == end);
        REQUIRE(run.end > run.begin);
        REQUIRE(run.end <= names.size());
        REQUIRE(run.bin < NameBins::count);
        end = run.end;
        for (std::uint32_t i = run.begin; i < run.end; ++i) CHECK(bins.of(names[i]) == run.bin);
        std::sort(names.begin() + run.begin, names.begin() + run.end);
      }
      CHECK(end == names.size());
      CHECK(names == sorted);
    }
  }
}

}  // namespace graze::tests
