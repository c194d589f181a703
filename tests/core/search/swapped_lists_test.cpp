// Lists of a search that are swapped with each other get the same room, so that it does not matter how often
// they were.

#include "base/working_memory.hpp"
#include "support/catch.hpp"
#include "walk/dmv.hpp"

namespace graze::tests {

TEST_CASE("swapped lists: both fronts of a walk get the room of the largest, one's own and another's") {
  DmvScratch own;
  DmvScratch other;
  own.front.reserve(300);
  other.next.reserve(200);
  reserve_as(other, own);
  CHECK(other.front.capacity() >= 300);
  CHECK(other.next.capacity() >= 300);
  reserve_as(own, DmvScratch());
  CHECK(own.next.capacity() >= 300);
}

}  // namespace graze::tests
