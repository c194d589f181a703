#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace graze::io {

/// Names of which no two are equal. The cost of a name does not depend on how many are equal to it.
class UniqueNames {
 public:
  /// Takes a name out of those that `make` may give.
  void reserve(const std::string& name) { taken_.insert(name); }

  /// Gives the wanted name, or if it is taken the first of `wanted#2`, `wanted#3`, … that is not.
  std::string make(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    std::size_t& copy = next_copy_.try_emplace(wanted, 2).first->second;
    for (;;) {
      std::string name = wanted + "#" + std::to_string(copy++);
      if (taken_.insert(name).second) return name;
    }
  }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> next_copy_;
};

}  // namespace graze::io
