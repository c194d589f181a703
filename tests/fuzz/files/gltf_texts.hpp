#pragma once

#include <string>
#include <vector>

namespace graze::fuzz {

/// glTF documents that go through everything that is checked and prepared: an animation, a skin without bind
/// matrices, morph targets, sparse accessors, nodes without a name or with the same.
std::vector<std::string> gltf_texts();

}  // namespace graze::fuzz
