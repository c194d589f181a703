#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/pair/group_filter.hpp"
#include "objects/object.hpp"
#include "pairs/ignored_groups.hpp"

namespace graze {

/// Copies of the groups of faces that are ignored between a tool and the objects near it. The groups of the
/// scene may change while a report has a copy. One that has not changed is shared with the step before.
class IgnoredCopies {
 public:
  /// Begins a step. What it does not ask for is forgotten.
  void begin();
  /// The copy for a tool and another object. A step asks about each object once, in the order of addition.
  [[nodiscard]] std::shared_ptr<const GroupFilter> of(const Object& tool, const Object& other,
                                                      const PairGroups& groups);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Copy {
    std::uint64_t serial = 0;   ///< of the other object
    std::uint64_t version = 0;  ///< PairGroups::version
    std::shared_ptr<const GroupFilter> filter;
  };

  std::vector<Copy> copies_;  ///< ascending by serial
  std::vector<Copy> last_;    ///< of the step before
  std::size_t next_ = 0;      ///< in `last_`
};

}  // namespace graze
