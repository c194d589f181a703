#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "object_store.hpp"

namespace graze {

/// Two objects by their places in the store, the lower first.
using ObjectPair = std::pair<std::uint32_t, std::uint32_t>;

/// Sort and sweep: the pairs of objects whose boxes may be nearer than a distance.
class BroadPhase {
 public:
  /// Every pair whose boxes are within `reach` and both margins of each other, and perhaps others; sorted.
  /// The answer stands until the next call.
  std::span<const ObjectPair> find(std::span<const std::unique_ptr<Object>> objects, double reach);

 private:
  struct Interval {
    double begin;
    double end;
    std::uint32_t object;
  };
  std::vector<Box> boxes_;
  std::vector<Interval> intervals_;
  std::vector<Interval> open_;
  std::vector<ObjectPair> pairs_;
};

}  // namespace graze
