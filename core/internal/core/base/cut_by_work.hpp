#pragma once

#include <cstddef>

namespace graze {

/// Cuts `begin` … `end` - 1 into ranges, each as short as has `each` of work in it. The last may have less.
/// Calls `take(begin, end)` for every range, in order.
template <typename WorkOf, typename AddRange>
void cut_by_work(std::size_t begin, std::size_t end, std::size_t each, const WorkOf& work_of,
                 const AddRange& add_range) {
  std::size_t work = 0;
  for (std::size_t i = begin; i < end; ++i) {
    work += work_of(i);
    if (work < each && i + 1 < end) continue;
    add_range(begin, i + 1);
    begin = i + 1;
    work = 0;
  }
}

}  // namespace graze
