#pragma once

#include <graze/graze.hpp>
#include <set>
#include <utility>

namespace loops {

/// Checks that begin and end events come in pairs: what begins was not in contact, and what ends was.
class EventCheck {
 public:
  void take(const graze::FrameReport& report);
  [[nodiscard]] std::size_t began() const { return began_; }
  [[nodiscard]] std::size_t ended() const { return ended_; }
  /// Returns how many rows did not fit the rows before them.
  [[nodiscard]] std::size_t mistakes() const { return mistakes_; }

 private:
  std::set<std::pair<std::uint64_t, std::uint64_t>> touching_;  ///< by the user data of both objects
  std::size_t began_ = 0, ended_ = 0, mistakes_ = 0;
};

}  // namespace loops
