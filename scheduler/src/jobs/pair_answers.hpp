#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_buffer.hpp"
#include "core/pair/pair_answer.hpp"

namespace graze {

/// A PairAnswer whose lists are stored elsewhere.
struct KeptAnswer : PairFinding {
  std::span<const Contact> contacts;
  std::span<const RegionDistance> region_distances;
};

/// The answers of a step's jobs. Their contacts are in one buffer, which grows with the number of contacts of
/// all pairs together. Only the stepping thread uses this, but any thread may call `keep` and `refer_to` for
/// different jobs.
class PairAnswers {
 public:
  explicit PairAnswers(unsigned workers) : contacts_(workers), region_distances_(workers) {}

  /// Begins a step with `count` jobs.
  void begin(std::size_t count);
  /// Copies a job's answer. The calls of one worker do not overlap.
  void keep(std::size_t job, const PairAnswer& answer, unsigned worker);
  /// Copies a job's answer without its contacts. It keeps their number until `set_contacts` says which
  /// contacts are kept.
  void keep_without_contacts(std::size_t job, const PairAnswer& answer, unsigned worker);
  /// Notes the number of contacts of a job that repeats its last answer.
  void repeat_without_contacts(std::size_t job, std::size_t contacts);
  /// Sets the contacts that are kept of a job.
  void set_contacts(std::size_t job, std::span<const Contact> contacts);
  /// Keeps an answer without a copy: its lists stay where they are.
  void refer_to(std::size_t job, const PairAnswer& answer);
  /// The answer of a job that was answered in this step, valid until `grow_to_demand`.
  [[nodiscard]] const KeptAnswer& operator[](std::size_t job) const { return answers_[job]; }

  /// Grows the buffers so that a step with answers of this size allocates nothing. Discards all lists.
  void grow_to_demand();
  /// Reserves memory for that many answers, and for the contacts and distances of all of them together.
  void reserve(std::size_t answers, std::size_t contacts, std::size_t region_distances);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  std::vector<KeptAnswer> answers_;
  SharedBuffer<Contact> contacts_;
  SharedBuffer<RegionDistance> region_distances_;
};

}  // namespace graze
