#include "core/sweep/sweep_counters.hpp"

#include <array>
#include <bit>

namespace graze {

/// Adds the counters as one array, so that none of them can be left out.
void SweepCounters::add(const SweepCounters& other) {
  using Numbers = std::array<std::uint64_t, sizeof(SweepCounters) / sizeof(std::uint64_t)>;
  auto sum = std::bit_cast<Numbers>(*this);
  const auto added = std::bit_cast<Numbers>(other);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += added[i];
  *this = std::bit_cast<SweepCounters>(sum);
}

}  // namespace graze
