#pragma once

#include <array>
#include <cstdint>
#include <graze/report.hpp>
#include <string_view>
#include <vector>

#include "stress/drifting_bodies.hpp"

namespace graze::tools {

inline constexpr std::array<std::string_view, 5> phase_names = {"read", "pairs", "refit", "jobs", "publish"};

/// A step's median times with some number of threads, in ms.
struct StepTimes {
  double wall_ms = 0;
  double cpu_ms = 0;  ///< of all threads
  std::array<double, phase_names.size()> phases_ms{};
};

/// Measurements of a world's frames, each with one thread and with two, in turn.
struct ScalingRun {
  std::size_t frames = 0;
  StepTimes one, two;
  double read_ms = 0;  ///< of reading all positions once, one thread's processor time
  std::uint64_t hash_one = 0, hash_two = 0;
  StepStatistics statistics;  ///< of the last step with one thread

  /// How much faster two threads did arithmetic that shares nothing, between the steps: what the machine had
  /// to give.
  double control_speedup = 0;

  /// Other load left no two cores, so that two threads cannot show what they are worth.
  [[nodiscard]] bool is_disturbed() const { return control_speedup < 1.9; }
  [[nodiscard]] double speedup() const { return one.wall_ms / two.wall_ms; }
  /// Amdahl's serial fraction from the times of a step: 1 / speedup = f + (1 - f) / 2, within 0 and 1.
  [[nodiscard]] double serial_fraction() const;
  /// The serial fraction calculated for each phase by itself, and then averaged by the phases' shares of a
  /// step.
  [[nodiscard]] double serial_fraction_by_phases() const;
};

ScalingRun run_scaling(DriftingBodies& world, std::size_t frames);

/// The speedup on `threads` threads that a serial fraction leaves.
double predicted_speedup(double serial_fraction, unsigned threads);

/// The exponent e of the power law y ~ x^e that fits best: least squares of the logarithms.
double growth_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace graze::tools
