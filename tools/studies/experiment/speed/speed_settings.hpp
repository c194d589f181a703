#pragma once

#include <vector>

#include "accuracy/modes.hpp"

namespace graze::tools {

/// The question that a program asks of a step. Both are about vertices, which all accuracy modes can answer.
enum class SpeedQuestion : std::uint8_t {
  contacts,  ///< every vertex pair closer than the contact distance, and pairs of objects in that range
  distances  ///< and how far each pair of objects is apart, however far
};

/// Exact mode, which all others are compared with.
ModeSetting exact_speed_setting(SpeedQuestion question, double contact_distance);

/// Every accuracy mode at several places of its dial, exact mode left out. Tolerances are in mean edge
/// lengths, and as loose as the regions of each level (eq. 6). The paper's test goes by eq. 3 and 6, and by
/// parts of those numbers. Work budgets are parts of `exact_work`, the most region pairs that a step of exact
/// mode tests. Contacts do not hang on the tolerance, so that for them there is only one.
std::vector<ModeSetting> speed_settings(const MovingSurfaces& scene, SpeedQuestion question,
                                        double contact_distance, std::uint64_t exact_work);

/// Time budgets that are parts of `exact_ms`, the longest step of exact mode. Their answers depend on the
/// machine.
std::vector<ModeSetting> timed_speed_settings(SpeedQuestion question, double contact_distance,
                                              double exact_ms);

}  // namespace graze::tools
