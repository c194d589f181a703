#pragma once

#include <cstdint>
#include <graze/report.hpp>

namespace graze::scenes {

/// A hash (FNV-1a over 64-bit words) of what reports say, bit for bit: frames, ids, phases, bounds,
/// witnesses, contacts and the kinds of diagnostics. They also say where one is inside the other, and
/// contacts that limits left out. Where pairs were swept and something met, they say impacts, and when
/// surfaces meet or come near. Statistics and times of the clock play no part.
class ReportHash {
 public:
  void add(const FrameReport& report);
  /// All of it but since when, which earlier steps have to do with.
  void add(const Contact& contact);
  /// Bounds and witness of a row, and nothing else of it.
  void add_distance(const PairReport& pair);
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3U; }
  void add(double number);
  void add(const Eigen::Vector3d& point);
  void add(const Feature& feature);
  void add(ObjectId id);
  void add(const WayOut& way);
  void add(const Impact& impact);
  void add(const PairReport& pair);

  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace graze::scenes
