#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "experiment/study.hpp"

namespace graze::tools {

/// RFC 4180, but for lines that end in \n. Numbers are the shortest that read back as the same double.
std::string csv_of(const ResultTable& table);
/// A row for each point: series, x, y, label.
std::string csv_of(const Figure& figure);

/// Writes STUDY_TABLE.csv for each table, and STUDY_FIGURE.points.csv for each figure. Throws
/// io::InputError for a file that cannot be written.
void write_csv(const std::filesystem::path& folder, std::span<const Study> studies);

}  // namespace graze::tools
