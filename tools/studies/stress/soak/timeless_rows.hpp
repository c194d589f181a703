#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/report.hpp>
#include <map>
#include <string>
#include <vector>

namespace graze::tools {

/// The part of a report about one pair that does not depend on earlier steps.
struct TimelessRow {
  std::size_t a = 0, b = 0;  ///< by the order in which objects were added
  bool in_contact = false;
  bool stale = false;
  std::uint64_t hash = 0;  ///< of bounds, witness and contacts, or of the contacts alone
  bool just_ended = false;
};

/// One for each pair. Without exactness pairs that are not in contact are left out,
/// since which are listed is not fixed, and of the others only the contacts count.
std::vector<TimelessRow> timeless_rows(const FrameReport& report,
                                       const std::map<ObjectId, std::size_t>& places, bool is_exact);

/// The first difference from the rows of a scene built afresh, which does not list what just ended and is
/// far. Empty where there is none.
std::string difference_of(std::vector<TimelessRow> found, const std::vector<TimelessRow>& fresh);

}  // namespace graze::tools
