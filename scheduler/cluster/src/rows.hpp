#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <memory>
#include <span>
#include <vector>

#include "messages.hpp"

namespace graze::cluster {

/// A row of a report, with what belongs to it. Its ids are those that callers know.
struct ClusterRow {
  PairReport pair;
  std::vector<Contact> contacts;
  std::vector<Impact> impacts;

  [[nodiscard]] Number a() const { return pair.a.index; }
  [[nodiscard]] Number b() const { return pair.b.index; }
};

/// The row of a report, by other ids.
[[nodiscard]] ClusterRow row_of(const FrameReport& report, const PairReport& pair, ObjectId a, ObjectId b);

void write_row(ByteBuffer& buffer, const ClusterRow& row);
/// Reads the next row.
[[nodiscard]] ClusterRow read_row(ByteSource& source);
/// Reads the rows that were written up to the end of `bytes`, and appends them.
void read_rows(std::span<const std::byte> bytes, std::vector<ClusterRow>& rows);

/// Sorts rows in the order of a report.
void sort_rows(std::vector<ClusterRow>& rows);

/// Makes a report of rows in their order.
[[nodiscard]] std::unique_ptr<FrameReport> report_of(std::span<const ClusterRow> rows, std::uint64_t frame,
                                                     std::uint64_t tag);

}  // namespace graze::cluster
