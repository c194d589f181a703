#pragma once

#include <string>
#include <string_view>

#include "bench/contender.hpp"

namespace graze::bench {

/// The module with all contenders but graze, which stands beside the program. It stays loaded for good.
class PeerModule {
 public:
  /// Throws io::InputError where it cannot be loaded.
  PeerModule();

  [[nodiscard]] PeerList entries() const { return entries_; }
  /// The entry of a name; throws io::InputError where there is none.
  [[nodiscard]] const PeerEntry& entry(std::string_view name) const;
  /// Compiler flags.
  [[nodiscard]] std::string compiled_for() const { return std::string(compiled_for_); }

 private:
  PeerList entries_;
  std::string_view compiled_for_;
};

}  // namespace graze::bench
