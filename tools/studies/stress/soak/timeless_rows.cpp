#include "stress/soak/timeless_rows.hpp"

#include <algorithm>
#include <tuple>

#include "output/text.hpp"
#include "scenes/report_hash.hpp"

namespace graze::tools {
namespace {

std::string name_of(const TimelessRow& row) {
  return format("pair (%zu, %zu)%s", row.a, row.b, row.in_contact ? " in contact" : "");
}

bool is_same(const TimelessRow& left, const TimelessRow& right) {
  const auto key = [](const TimelessRow& row) {
    return std::tie(row.a, row.b, row.in_contact, row.stale, row.hash);
  };
  return key(left) == key(right);
}

}  // namespace

std::vector<TimelessRow> timeless_rows(const FrameReport& report,
                                       const std::map<ObjectId, std::size_t>& places, bool is_exact) {
  std::vector<TimelessRow> rows;
  for (const PairReport& pair : report.pairs()) {
    if (!places.contains(pair.a) || !places.contains(pair.b))
      continue;  // it ended since an object was removed
    const bool in_contact = pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
    if (!in_contact && !is_exact) continue;
    scenes::ReportHash hash;
    if (is_exact) hash.add_distance(pair);
    for (const Contact& contact : report.contacts(pair)) hash.add(contact);
    rows.push_back({places.at(pair.a), places.at(pair.b), in_contact, pair.stale, hash.value(),
                    pair.phase == PairPhase::ended});
  }
  return rows;
}

std::string difference_of(std::vector<TimelessRow> found, const std::vector<TimelessRow>& fresh) {
  std::erase_if(found, [&](const TimelessRow& row) {
    return row.just_ended && std::none_of(fresh.begin(), fresh.end(), [&](const TimelessRow& other) {
             return other.a == row.a && other.b == row.b;
           });
  });
  const auto [in_found, in_fresh] =
      std::mismatch(found.begin(), found.end(), fresh.begin(), fresh.end(), is_same);
  if (in_found == found.end() && in_fresh == fresh.end()) return {};
  if (in_found == found.end()) return name_of(*in_fresh) + " is missing";
  if (in_fresh == fresh.end()) return name_of(*in_found) + " is not in a scene built afresh";
  return name_of(*in_found) + " differs from " + name_of(*in_fresh) + " of a scene built afresh";
}

}  // namespace graze::tools
