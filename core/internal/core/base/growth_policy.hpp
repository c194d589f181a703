#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace graze {

/// How many elements to reserve where `count` do not fit: half as many again. So a number that rises a little
/// from step to step takes memory a few times only. The rest costs addresses, since memory that nobody has
/// written to does not exist yet.
constexpr std::size_t with_growth_room(std::size_t count) {
  return count + count / 2;
}

/// Makes room for elements that are all to be written over. Where there is too little, what there was is
/// gone: neither is it copied, nor is the new memory touched.
template <typename Element>
void reserve_to_overwrite(std::vector<Element>& elements, std::size_t room) {
  if (elements.capacity() >= room) return;
  std::vector<Element>().swap(elements);  // first, so that both are never there at once
  elements.reserve(room);
}

/// As the function above, for a list that one object has and many others have about as long. From the first
/// time on it reserves enough for most of them, but never more than the list may ever need.
template <typename Element>
void reserve_for_one_of_many(std::vector<Element>& elements, std::size_t count, std::size_t most) {
  constexpr std::size_t least = 64;
  if (elements.capacity() < count)
    reserve_to_overwrite(elements, std::min(std::max(with_growth_room(count), least), most));
}

/// Makes them so many, all to be written over: those that there were stay what they are, so that in most
/// steps none is made.
template <typename Element>
void resize_to_overwrite(std::vector<Element>& elements, std::size_t count) {
  if (count > elements.capacity()) reserve_to_overwrite(elements, with_growth_room(count));
  // Made in place each would be zeroed first, by a slow string store.
  elements.resize(count, Element{});
}

}  // namespace graze
