// NameSet holds what a std::set would.

#include "names/name_set.hpp"

#include <set>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

ContactName name_of(std::uint32_t a, std::uint32_t b) {
  return ContactName::of(vertex_piece(a), vertex_piece(b));
}

}  // namespace

TEST_CASE("names at one distance are each kept once, and in order when they are settled") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    oracle::Random random(seed);
    const std::uint32_t range = 1 + random.below(80);
    NameSet names;
    std::set<ContactName> expected;
    for (std::uint32_t i = 0; i < 3000; ++i) {
      const auto [a, b] = seed % 3 == 0 ? std::pair{i / range, i % range}
                                        : std::pair{random.below(range), random.below(range)};
      const ContactName name = name_of(a, b);
      REQUIRE(names.contains(name) == (expected.count(name) != 0));
      if (!expected.insert(name).second) continue;
      names.add(name);
      if (random.below(500) == 0) names.settle();
    }
    names.settle();
    CHECK(names.names() == std::vector<ContactName>(expected.begin(), expected.end()));
    CHECK(names.front() == *expected.begin());
    names.assign(name_of(7, 7));
    CHECK(names.names() == std::vector{name_of(7, 7)});
    CHECK_FALSE(names.contains(*expected.rbegin()));
  }
}

}  // namespace graze::tests
