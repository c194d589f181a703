#include "core/base/require.hpp"
#include "objects/object.hpp"

namespace graze {

#ifdef GRAZE_VALIDATE
namespace {

void validate_input(const Object& object) {
  const auto must = [&](bool holds, const char* what) { require(holds, what, object.serial); };
  must(!object.pose, "a pose was neither accepted nor refused");
  must(object.is_posed() || !object.standing_pose, "a deformable object has a pose");
  must(!object.is_posed() || (!object.positions && !object.bound), "a posed object has positions");
  must(!object.positions || !object.bound, "an object has copied positions and bound memory");
}

void validate_state(const Object& object) {
  const auto must = [&](bool holds, const char* what) { require(holds, what, object.serial); };
  must(object.plan == ReadPlan::skip, "a read was planned and not done");
  must(!object.was_surveyed() || !object.seen.is_in_surface, "a survey has moved a surface");
  switch (object.state) {
    case ReadState::read:
      return;
    case ReadState::viewed:
      must(object.is_read_in_every_step(), "memory is viewed that is not read in every step");
      must(!object.frozen, "an object at bad positions is viewed");
      return must(!object.seen.is_in_surface, "viewed positions are the surface's own");
    case ReadState::due:
      return must(object.frozen, "good input was neither read nor surveyed");
    case ReadState::unread:
      must(object.positions || object.bound, "an object without positions is unread");
      return must(object.promises.are_bounds(), "an object without promises is unread");
    case ReadState::surveyed:
      return must(object.is_posed() ? object.standing_pose.has_value() : object.positions || object.bound,
                  "an object without input was surveyed");
    case ReadState::still_surveyed:
      must(!object.promises.next, "input came since the survey");
      return must(!object.is_read_in_every_step(), "memory was not surveyed in this step");
  }
}

}  // namespace

void validate(std::span<const std::unique_ptr<Object>> objects) {
  for (const auto& object : objects) {
    validate_input(*object);
    validate_state(*object);
  }
}
#else
void validate(std::span<const std::unique_ptr<Object>> /*objects*/) {}
#endif

}  // namespace graze
