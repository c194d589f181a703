#include "base/access.hpp"

#ifdef GRAZE_VALIDATE
#include <stdexcept>
#include <string>
#include <utility>

namespace graze {
namespace {

thread_local AccessRights rights{AccessRight::everything(), AccessRight::everything()};

void require_right(StepData data, const void* one, bool writes) {
  const AccessRight& right = data == StepData::surfaces ? rights.surfaces : rights.pairs;
  using Level = AccessRight::Level;
  const bool own = right.level == Level::write_one && right.one == one;
  if (right.level == Level::write || own || (right.level == Level::read && !writes)) return;
  throw std::logic_error(std::string("graze validator: a task ") + (writes ? "writes " : "reads ") +
                         (data == StepData::surfaces ? "a surface" : "a pair") + " that it did not declare");
}

}  // namespace

AccessScope::AccessScope(const AccessRights& declared) : before_(std::exchange(rights, declared)) {}

AccessScope::~AccessScope() {
  rights = before_;
}

void require_read(StepData data, const void* one) {
  require_right(data, one, false);
}

void require_write(StepData data, const void* one) {
  require_right(data, one, true);
}

}  // namespace graze
#endif
