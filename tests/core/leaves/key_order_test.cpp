// KeyOrder sorts as comparing does.

#include "closest_features/key_order.hpp"

#include <algorithm>
#include <vector>

#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

FeaturePiece random_piece(oracle::Random& random, std::uint32_t largest) {
  // Now and then the largest itself, so that the list needs all of its bits.
  const std::uint32_t index = random.chance(0.1) ? largest : random.below(largest);
  return {{static_cast<FeatureKind>(random.below(3)), index}, static_cast<Piece>(random.below(3))};
}

}  // namespace

TEST_CASE("key order: sorts as comparing does, however many and however large the keys are") {
  KeyOrder order;
  for (std::uint64_t seed = 0; seed < 90; ++seed) {
    oracle::Random random(seed);
    // The sum of the bits of both indices decides whether a key is a number of 64 bits.
    const std::uint32_t largest_a = 1U << random.below(32);
    const std::uint32_t largest_b = 1U << random.below(32);
    std::vector<FeaturePairKey> keys;
    const std::uint32_t count = random.below(seed % 2 == 0 ? 100 : 2000);
    for (std::uint32_t i = 0; i < count; ++i) {
      const FeaturePiece a = random_piece(random, largest_a);
      const FeaturePiece b = random_piece(random, largest_b);
      keys.push_back(FeaturePairKey::of(a, b, static_cast<Meeting>(random.below(3))));
    }
    if (seed % 3 == 0)  // as where those of a come in order
      std::stable_sort(keys.begin(), keys.end(),
                       [](const auto& left, const auto& right) { return left.of_a() < right.of_a(); });
    std::vector<FeaturePairKey> expected = keys;
    std::sort(expected.begin(), expected.end());
    order.sort(keys);
    CHECK(keys == expected);
  }
}

}  // namespace graze::tests
