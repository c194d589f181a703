#pragma once

#include <filesystem>
#include <graze/io/report_json.hpp>
#include <string>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// Every frame of a report file.
std::vector<io::ReportedFrame> read_report(const std::filesystem::path& path);

/// The shapes of all objects in one frame, as the test itself expects them.
using ExpectedShapes = std::vector<oracle::Shape>;

struct Thresholds {
  double contact_distance = 0;
  double range = 0;
};

/// Compares a run of detail `features` with brute force over `frames`, which are exactly the positions that
/// the program saw: pairs, phases, distances to the last bit, the whole set of contacts. Returns how many
/// contacts that were.
std::size_t check_exactly(const std::vector<io::ReportedFrame>& report,
                          const std::vector<ExpectedShapes>& frames, const Thresholds& thresholds);

/// Compares a run with brute force where the positions agree only within `tolerance`, and no distance is that
/// near to a threshold. Compares pairs, phases and distances, and checks that each contact lies on the
/// features it names. Returns how many contacts that were.
std::size_t check_nearly(const std::vector<io::ReportedFrame>& report,
                         const std::vector<ExpectedShapes>& frames, const Thresholds& thresholds,
                         double tolerance);

}  // namespace graze::tests
