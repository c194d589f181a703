#pragma once

#include <graze/contact.hpp>
#include <optional>

#include "objects/object.hpp"

namespace graze {

/// Returns what a feature of the last report is called now. Without a replaced mesh that is the feature
/// itself. Otherwise it is the feature of the same kind that has exactly the vertices to which those of the
/// old one are mapped, and nothing if there is none. Of several faces with the same vertices the first old
/// one becomes the first new one, and so on. Stepping thread only.
[[nodiscard]] std::optional<Feature> mapped_feature(const Object& object, const Feature& feature);

}  // namespace graze
