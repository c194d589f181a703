#include "names/name_bins.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace graze {

NameBins::NameBins(const IndexedMesh& mesh_a) {
  const std::array counts{mesh_a.vertex_count(), mesh_a.edge_count(), mesh_a.face_count()};
  std::transform(counts.begin(), counts.end(), shift_.begin(), [](std::uint32_t of_kind) {
    return std::max(0, static_cast<int>(std::bit_width(of_kind)) - index_bits);
  });
}

void NameBinning::put_into(const NameBins& bins, std::vector<ContactName>& names, std::vector<BinRun>& runs) {
  std::array<std::uint32_t, NameBins::count> next{};
  std::size_t first = NameBins::count;
  std::size_t last = 0;
  for (const ContactName& name : names) {
    const std::size_t bin = bins.of(name);
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
  names_.assign(names.begin(), names.end());  // and not swapped: a list keeps its own memory
  for (const ContactName& name : names_) names[next[bins.of(name)]++] = name;
}

}  // namespace graze
