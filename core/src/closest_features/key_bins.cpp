#include "closest_features/key_bins.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace graze {

KeyBins::KeyBins(const IndexedMesh& mesh_a) {
  const std::array counts{mesh_a.vertex_count(), mesh_a.edge_count(), mesh_a.face_count()};
  std::transform(counts.begin(), counts.end(), shift_.begin(), [](std::uint32_t of_kind) {
    return std::max(0, static_cast<int>(std::bit_width(of_kind)) - index_bits);
  });
}

void KeyBinning::put_into(const KeyBins& bins, std::vector<FeaturePairKey>& keys, std::vector<BinRun>& runs) {
  std::array<std::uint32_t, KeyBins::count> next{};
  std::size_t first = KeyBins::count;
  std::size_t last = 0;
  for (const FeaturePairKey& key : keys) {
    const std::size_t bin = bins.of(key);
    first = std::min(first, bin);
    last = std::max(last, bin);
    ++next[bin];
  }
  runs.clear();
  std::uint32_t begin = 0;
  for (std::size_t bin = first; bin <= last; ++bin) {
    if (next[bin] == 0) continue;
    const std::uint32_t end = begin + next[bin];
    runs.push_back({static_cast<std::uint32_t>(bin), begin, end});
    next[bin] = std::exchange(begin, end);
  }
  keys_.assign(keys.begin(), keys.end());  // and not swapped: a list keeps its own memory
  for (const FeaturePairKey& key : keys_) keys[next[bins.of(key)]++] = key;
}

}  // namespace graze
