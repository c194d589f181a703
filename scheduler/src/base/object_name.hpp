#pragma once

#include <graze/object_id.hpp>
#include <string>

namespace graze {

/// The name in messages of an object of which only the id is known, such as `object 3`.
inline std::string number_of(ObjectId object) {
  return "object " + std::to_string(object.index);
}

/// The name of an object in messages, such as `object 3 'liver'`. `named` has settings with a name.
template <typename Named>
std::string name_of(ObjectId object, const Named& named) {
  return named.settings.name.empty() ? number_of(object)
                                     : number_of(object) + " '" + named.settings.name + "'";
}

}  // namespace graze
