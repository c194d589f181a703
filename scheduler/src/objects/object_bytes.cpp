#include "objects/object_bytes.hpp"

#include <utility>

namespace graze {

void ObjectBytes::count(Object& object) {
  const std::size_t bytes = object.surface().byte_count() +
                            (object.face_groups == nullptr ? 0 : object.face_groups->byte_count()) +
                            (object.sweep == nullptr ? 0 : object.sweep->motion.byte_count()) +
                            (object.self == nullptr ? 0 : object.self->byte_count());
  if (bytes == object.counted_bytes) return;
  sum_.fetch_add(bytes - std::exchange(object.counted_bytes, bytes), std::memory_order_relaxed);
}

}  // namespace graze
