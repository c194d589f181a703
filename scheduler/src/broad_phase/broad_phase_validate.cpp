#include "broad_phase/broad_phase.hpp"
#include "core/base/require.hpp"

namespace graze {

#ifdef GRAZE_VALIDATE
namespace {

/// The pairs are compared one by one only up to this many objects.
constexpr std::size_t most_objects = 200;

bool encloses(const Box& box, const Box& other) {
  return (box.min.array() <= other.min.array()).all() && (other.max.array() <= box.max.array()).all();
}

bool overlap_or_touch(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

}  // namespace

void validate(const ObjectSummaries& summaries, const BroadPhase::HalfReaches& half_reaches,
              const IgnoredPairs& ignored, std::span<const Box> loose, std::span<const SlotPair> pairs) {
  require(summaries.all().size() == loose.size(), "not every object has a loose box", loose.size());
  for (std::size_t slot = 0; slot < loose.size(); ++slot) {
    const ObjectSummary& summary = summaries.all()[slot];
    require(encloses(loose[slot], grown(summaries.whole_box(static_cast<std::uint32_t>(slot)),
                                        half_reaches[summary.kind] + summary.margin)),
            "a loose box does not contain its object", slot);
  }
  for (std::size_t i = 1; i < pairs.size(); ++i) require(pairs[i - 1] < pairs[i], "pairs do not ascend", i);
  if (loose.size() > most_objects) return;
  auto pair = pairs.begin();
  for (std::uint32_t first = 0; first < loose.size(); ++first)
    for (std::uint32_t second = first + 1; second < loose.size(); ++second) {
      const ObjectSummary& a = summaries[first];
      const ObjectSummary& b = summaries[second];
      if (!overlap_or_touch(loose[first], loose[second])) continue;
      if (lasting_verdict(a, b) != PairVerdict::tested || ignored.contains({a.serial, b.serial})) continue;
      require(pair != pairs.end() && *pair == pair_of(first, second), "a pair of loose boxes is missing",
              first);
      ++pair;
    }
  require(pair == pairs.end(), "a pair is listed that a filter takes out, or whose loose boxes do not meet",
          pairs.size());
}
#else
void validate(const ObjectSummaries&, const BroadPhase::HalfReaches&, const IgnoredPairs&,
              std::span<const Box>, std::span<const SlotPair>) {}
#endif

}  // namespace graze
