// KeySet holds what a std::set would.

#include "closest_features/key_set.hpp"

#include <set>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

FeaturePairKey key_of(std::uint32_t a, std::uint32_t b) {
  return FeaturePairKey::of(vertex_piece(a), vertex_piece(b));
}

}  // namespace

TEST_CASE("key set: each key is kept once, and merge_runs() sorts them") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    oracle::Random random(seed);
    const std::uint32_t range = 1 + random.below(80);
    KeySet keys;
    std::set<FeaturePairKey> expected;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      const auto [a, b] = seed % 3 == 0 ? std::pair{i / range, i % range}
                                        : std::pair{random.below(range), random.below(range)};
      const FeaturePairKey key = key_of(a, b);
      REQUIRE(keys.contains(key) == (expected.count(key) != 0));
      if (!expected.insert(key).second) continue;
      keys.add(key);
      if (random.below(500) == 0) keys.merge_runs();
    }
    keys.merge_runs();
    CHECK(keys.keys() == std::vector<FeaturePairKey>(expected.begin(), expected.end()));
    CHECK(keys.front() == *expected.begin());
    keys.assign(key_of(7, 7));
    CHECK(keys.keys() == std::vector{key_of(7, 7)});
    CHECK_FALSE(keys.contains(*expected.rbegin()));
  }
}

}  // namespace graze::tests
