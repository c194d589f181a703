#pragma once

#include <graze/object_id.hpp>
#include <string>

namespace graze {

/// How messages name an object: `object 3 'liver'`. `named` has settings with a name.
template <typename Named>
std::string name_of(ObjectId object, const Named& named) {
  const std::string number = "object " + std::to_string(object.index);
  return named.settings.name.empty() ? number : number + " '" + named.settings.name + "'";
}

}  // namespace graze
