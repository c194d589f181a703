#pragma once

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstddef>
#include <vector>

#include "core/base/growth_policy.hpp"
#include "pair/time_limit.hpp"

namespace graze {

// New memory costs many times more when it is first written to than later. Where there is a deadline it is
// written to piece by piece, with checks of the clock in between. The part that was written to stays.

/// `resize_to_overwrite`, which ends when the time does: throws TimeIsUp. `time` is null where there is no
/// deadline.
template <typename Element>
void make_room_in_time(std::vector<Element>& elements, std::size_t count, TimeLimit* time) {
  if (time == nullptr) return resize_to_overwrite(elements, count);
  constexpr std::size_t at_once = 16384 / sizeof(Element);
  if (count > elements.capacity()) reserve_to_overwrite(elements, with_growth_room(count));
  if (elements.size() > count) elements.resize(count, Element{});
  while (elements.size() < count) {
    time->check_for({});
    elements.resize(std::min(count, elements.size() + at_once), Element{});
  }
}

/// Reserves room for all elements that a search can find before its deadline, if each takes at least so long.
/// Added one by one they are not copied on the way. Memory that is never written to costs addresses only.
template <typename Element>
void reserve_until_deadline(std::vector<Element>& elements, std::chrono::nanoseconds each, TimeLimit* time) {
  constexpr std::size_t most = std::size_t{1} << 21;
  if (time == nullptr) return;
  // A power of two: as good as never a little more than the last time, which would be new memory again.
  const auto wanted = std::bit_ceil(static_cast<std::size_t>(time->left() / each));
  elements.reserve(std::min(wanted, most));
}

}  // namespace graze
