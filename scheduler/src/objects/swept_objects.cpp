#include "objects/swept_objects.hpp"

namespace graze {

bool SweptObjects::take_up(const ObjectSettings& settings) {
  if (!settings.swept) return false;
  const std::uint32_t layers = layers_ | settings.layer;
  const std::uint32_t masks = masks_ | settings.collides_with;
  const bool is_wider = !some_ || layers != layers_ || masks != masks_;
  some_ = true;
  layers_ = layers;
  masks_ = masks;
  return is_wider;
}

void SweptObjects::begin_step(bool last_failed) {
  ++step_;
  if (!last_failed) unreported_step_ = step_;
}

/// A step that failed may have kept it already. A fixed object always stands. So does one that no step has
/// seen as it is now, and one that jumps.
bool SweptObjects::begin_keeping(Object& object, bool is_new) const {
  if (object.sweep == nullptr || object.settings.motion == Motion::fixed) return false;
  ObjectSweep& sweep = *object.sweep;
  if (sweep.jumps_step >= unreported_step_) sweep.kept_step = 0;
  if (sweep.kept_step >= unreported_step_ || sweep.jumps_step >= unreported_step_) return false;
  if (is_new || object.is_unplaced || object.replaced != nullptr || object.surface().is_behind() ||
      !object.seen.is_in_surface)
    return false;
  sweep.motion.make_room(object.surface());
  return true;
}

}  // namespace graze
