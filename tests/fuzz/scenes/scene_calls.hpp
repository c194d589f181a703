#pragma once

#include "fuzz/byte_reader.hpp"
#include "scene_model.hpp"

namespace graze::fuzz {

/// Settings that a scene takes, with every accuracy, detail, limit and budget.
SceneSettings read_scene_settings(ByteReader& reader);

/// Makes the one call that the next bytes mean. Steps are among them.
void make_call(ByteReader& reader, SceneModel& model);

}  // namespace graze::fuzz
