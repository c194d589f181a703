#pragma once

#include <filesystem>
#include <vector>

#include "experiment/paper/paper_rows.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Writes a recorded motion into a folder, which is made: each object's mesh and vertex cache, and a scene
/// file for each row, row_1.json and so on, and for exact mode at the best row's last number, exact.json, so
/// that `graze run` plays it. Throws std::runtime_error for a file that cannot be written.
void write_motion(const std::filesystem::path& folder, const RecordedMotion& motion,
                  const std::vector<PaperRow>& rows);

}  // namespace graze::tools
