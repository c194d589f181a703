#include "report_rows.hpp"

#include <cstdint>
#include <utility>

namespace graze {
namespace {

/// What contacts are ordered by, as two numbers.
std::pair<std::uint64_t, std::uint64_t> key_of(const Contact& contact) {
  const auto number = [](const Feature& feature) {
    return std::uint64_t{static_cast<std::uint8_t>(feature.kind)} << 32U | feature.index;
  };
  return {std::uint64_t{static_cast<std::uint8_t>(contact.kind)} << 40U | number(contact.feature_a),
          number(contact.feature_b)};
}

}  // namespace

std::optional<PairReport> repeated_row(const PairJob& job) {
  if (job.last == nullptr) return std::nullopt;
  PairReport row = *job.last;
  row.stale = job.task == PairJob::Task::repeat_last;
  if (row.phase == PairPhase::began) row.phase = PairPhase::touching;
  if (row.phase != PairPhase::ended) return row;
  row.phase = PairPhase::near;
  if (row.distance.lower < job.thresholds.reach) return row;
  return std::nullopt;
}

std::optional<PairReport> row_of(const PairJob& job, const KeptAnswer& answer) {
  const bool was = job.was_in_contact();
  PairReport row;
  row.a = job.a->id;
  row.b = job.b->id;
  row.complete = answer.complete;
  row.distance = answer.distance;
  row.witness = answer.witness;
  if (job.task == PairJob::Task::end)
    row.phase = PairPhase::ended;
  else if (!answer.complete)
    row.phase = was ? PairPhase::touching : PairPhase::near;
  else if (answer.in_contact)
    row.phase = was ? PairPhase::touching : PairPhase::began;
  else
    row.phase = was ? PairPhase::ended : PairPhase::near;
  if (answer.listed || was) return row;
  return std::nullopt;
}

void set_since(std::span<const Contact> last, std::span<Contact> contacts, std::uint64_t frame) {
  auto before = last.begin();
  for (Contact& contact : contacts) {
    const auto key = key_of(contact);
    while (before != last.end() && key_of(*before) < key) ++before;
    const bool is_old = before != last.end() && key_of(*before) == key;
    contact.since = is_old ? before->since : frame;
  }
}

}  // namespace graze
