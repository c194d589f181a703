#include "report_rows.hpp"

#include <tuple>

namespace graze {

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
  const auto key_of = [](const Contact& contact) {
    return std::tie(contact.kind, contact.feature_a, contact.feature_b);
  };
  auto before = last.begin();
  for (Contact& contact : contacts) {
    while (before != last.end() && key_of(*before) < key_of(contact)) ++before;
    const bool is_old = before != last.end() && key_of(*before) == key_of(contact);
    contact.since = is_old ? before->since : frame;
  }
}

}  // namespace graze
