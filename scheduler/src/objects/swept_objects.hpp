#pragma once

#include <cstdint>
#include <graze/settings.hpp>

#include "objects/object.hpp"

namespace graze {

/// Knows which objects may be in swept pairs, and how they move in a step. Without an object that is swept no
/// other object has an ObjectSweep. Stepping thread only, but for the functions that say so.
class SweptObjects {
 public:
  /// Whether an object is swept, or was before it was removed.
  [[nodiscard]] bool some() const { return some_; }
  /// Whether pairs with an object of these settings may be swept.
  [[nodiscard]] bool may_meet(const ObjectSettings& settings) const {
    return settings.swept || ((settings.layer & masks_) != 0 && (settings.collides_with & layers_) != 0);
  }
  /// Takes up the settings of an object that is added. Returns whether more objects may be in swept pairs.
  bool take_up(const ObjectSettings& settings);

  /// Begins the read of a step. After a step that failed, objects keep where the last report saw them.
  void begin_step(bool last_failed);
  /// Notes that an object jumps in the next step.
  void note_jump(Object& object) const {
    if (object.sweep != nullptr) object.sweep->jumps_step = step_ + 1;
  }
  /// Whether an object keeps where it is now, before it is read. Then it has room for that. `is_new` says
  /// that no step has seen it. Tasks may ask about different objects.
  [[nodiscard]] bool begin_keeping(Object& object, bool is_new) const;
  /// Ends that. Tasks may call it for different objects.
  void end_keeping(Object& object) const {
    object.sweep->motion.finish(object.surface());
    object.sweep->kept_step = step_;
  }

  /// The number of the current step.
  [[nodiscard]] std::uint64_t step() const { return step_; }
  /// Whether an object has moved in this step. Where it has not, it stands at its place from time 0 to 1.
  [[nodiscard]] bool moves(const Object& object) const {
    return object.sweep != nullptr && object.sweep->kept_step >= unreported_step_ &&
           object.sweep->jumps_step < unreported_step_ && !object.frozen &&
           object.sweep->motion.differs_from(object.surface());
  }

 private:
  bool some_ = false;  ///< some object is swept. One that is swept against itself may have no layer
  // The bits of all swept objects.
  std::uint32_t layers_ = 0;
  std::uint32_t masks_ = 0;
  std::uint64_t step_ = 0;             ///< the current one
  std::uint64_t unreported_step_ = 0;  ///< the first one after that of the last report
};

}  // namespace graze
