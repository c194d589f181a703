#pragma once

#include <graze/report.hpp>

namespace graze::tests {

/// Makes every second contact of a report sunk and gives pairs ways out, whatever they are, so that files can
/// be seen to keep both. Every third pair has no way out, and every third has one without a direction. Equal
/// reports stay equal. Nobody else may read the report meanwhile.
inline void mark_report(const FrameReport& report) {
  int number = 0;
  for (const PairReport& row : report.pairs()) {
    WayOut& way = const_cast<PairReport&>(row).way_out;  // no report is a constant
    const double share = 1.0 / (3 + number);
    way = {};
    if (number % 3 == 0) way = {{0.6, -share, 0.8}, {share, -0.0, 2}, 0.7 + share, 1 / 7.0, 9 + share};
    if (number % 3 == 1) way.point = {1, share, 0};
    ++number;
  }
  for (const Contact& contact : report.contacts()) const_cast<Contact&>(contact).sunk = number++ % 2 == 0;
}

/// Returns a copy of the report that mark_report() has marked.
inline FrameReport marked_report(const FrameReport& report) {
  FrameReport copy(report);
  mark_report(copy);
  return copy;
}

/// How many contacts of a report are sunk.
inline std::size_t sunk_count(const FrameReport& report) {
  std::size_t count = 0;
  for (const Contact& contact : report.contacts()) count += contact.sunk ? 1 : 0;
  return count;
}

}  // namespace graze::tests
