#include "division.hpp"

#include <algorithm>
#include <cmath>

namespace graze::cluster {
namespace {

/// A part of space that some ranks share.
struct Part {
  int first = 0;  ///< of these ranks
  int last = 0;   ///< behind them
  Box box;
  // The cut that is looked for.
  int axis = 0;
  double low = 0;
  double high = 0;

  [[nodiscard]] bool is_cut() const { return last - first > 1; }
  [[nodiscard]] int middle() const { return (first + last) / 2; }
  /// How much of the load belongs below the cut.
  [[nodiscard]] double share() const {
    return static_cast<double>(middle() - first) / static_cast<double>(last - first);
  }
};

constexpr std::size_t bins = 64;
constexpr int rounds = 3;  ///< each makes the cut finer by the number of bins

std::size_t bin_of(const Part& part, double at) {
  const double width = part.high - part.low;
  if (!(width > 0)) return 0;
  const double bin = std::floor((at - part.low) / width * static_cast<double>(bins));
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)));
}

double edge_of(const Part& part, std::size_t bin) {
  return part.low + (part.high - part.low) * static_cast<double>(bin) / static_cast<double>(bins);
}

void begin_cut(Part& part) {
  (part.box.max - part.box.min).maxCoeff(&part.axis);
  part.low = part.box.min[part.axis];
  part.high = part.box.max[part.axis];
}

/// The parts of a level, with what is below each cut so far.
class Level {
 public:
  Level(std::span<Part> parts, std::span<const Load> loads, std::span<const std::size_t> part_of, Post& post)
      : parts_(parts),
        loads_(loads),
        part_of_(part_of),
        post_(post),
        below_(parts.size()),
        all_(parts.size()) {}

  void find_cuts() {
    for (Part& part : parts_) begin_cut(part);
    for (int round = 0; round < rounds; ++round) narrow(round == 0);
  }

 private:
  /// Sums the loads of each bin over all ranks, and goes on in the bin in which the share is reached.
  void narrow(bool is_first) {
    std::vector<std::uint64_t> sums(parts_.size() * bins);
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      const Part& part = parts_[part_of_[i]];
      const double at = loads_[i].at[part.axis];
      if (!is_first && !(at >= part.low && at < part.high)) continue;
      sums[part_of_[i] * bins + bin_of(part, at)] += loads_[i].nanoseconds;
    }
    post_.sum(&ClusterStatistics::bytes_moves, sums);
    for (std::size_t index = 0; index < parts_.size(); ++index)
      narrow(index, std::span(sums).subspan(index * bins, bins), is_first);
  }

  void narrow(std::size_t index, std::span<const std::uint64_t> sums, bool is_first) {
    Part& part = parts_[index];
    if (is_first)
      for (const std::uint64_t sum : sums) all_[index] += sum;
    const double wanted = part.share() * static_cast<double>(all_[index]);
    std::size_t bin = 0;
    while (bin + 1 < bins && static_cast<double>(below_[index] + sums[bin]) < wanted)
      below_[index] += sums[bin++];
    const double low = edge_of(part, bin);
    part.high = edge_of(part, bin + 1);
    part.low = low;
  }

  std::span<Part> parts_;
  std::span<const Load> loads_;
  std::span<const std::size_t> part_of_;
  Post& post_;
  std::vector<std::uint64_t> below_;
  std::vector<std::uint64_t> all_;
};

}  // namespace

std::vector<int> divided(std::span<const Load> loads, const Box& all, Post& post) {
  std::vector<Part> parts{{0, post.size(), all}};
  std::vector<std::size_t> part_of(loads.size(), 0);
  while (std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_cut(); })) {
    Level(parts, loads, part_of, post).find_cuts();
    std::vector<Part> next;
    std::vector<std::size_t> lower_of(parts.size());
    for (std::size_t index = 0; index < parts.size(); ++index) {
      const Part& part = parts[index];
      lower_of[index] = next.size();
      if (!part.is_cut()) {
        next.push_back(part);
        continue;
      }
      Part lower{part.first, part.middle(), part.box};
      Part upper{part.middle(), part.last, part.box};
      lower.box.max[part.axis] = upper.box.min[part.axis] = part.high;
      next.push_back(lower);
      next.push_back(upper);
    }
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const Part& part = parts[part_of[i]];
      const bool is_upper = part.is_cut() && loads[i].at[part.axis] >= part.high;
      part_of[i] = lower_of[part_of[i]] + (is_upper ? 1 : 0);
    }
    parts = std::move(next);
  }
  std::vector<int> ranks(loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) ranks[i] = parts[part_of[i]].first;
  return ranks;
}

}  // namespace graze::cluster
