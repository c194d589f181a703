#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_buffer.hpp"
#include "core/pair/pair_answer.hpp"

namespace graze {

/// A PairAnswer whose lists are elsewhere.
struct KeptAnswer : PairFinding {
  std::span<const Contact> contacts;
  std::span<const RegionDistance> region_distances;
};

/// The answers of a step's jobs, and their contacts in a memory that follows how many there are of all pairs
/// together. Stepping thread only, but for `keep` and `refer_to`, which any threads may call for different
/// jobs.
class PairAnswers {
 public:
  explicit PairAnswers(unsigned workers) : contacts_(workers), region_distances_(workers) {}

  /// Begins a step with so many jobs.
  void begin(std::size_t count);
  /// Takes a copy of a job's answer. The calls of one worker do not overlap.
  void keep(std::size_t job, const PairAnswer& answer, unsigned worker);
  /// The same but for the contacts: how many there are, until it is known which of them are kept.
  void keep_without_contacts(std::size_t job, const PairAnswer& answer, unsigned worker);
  /// The same of a job that is not looked at, with so many contacts.
  void repeat_without_contacts(std::size_t job, std::size_t contacts);
  /// Says which are kept, for a job of which some are.
  void set_contacts(std::size_t job, std::span<const Contact> contacts);
  /// Takes an answer whose lists stay where they are.
  void refer_to(std::size_t job, const PairAnswer& answer);
  /// Of a job that was answered in this step; until `grow_to_demand`.
  [[nodiscard]] const KeptAnswer& operator[](std::size_t job) const { return answers_[job]; }

  /// Makes room, so that a step with answers like these takes no memory. All lists are gone then.
  void grow_to_demand();
  /// Makes room for so many answers, and lists of all of them together.
  void reserve(std::size_t answers, std::size_t contacts, std::size_t region_distances);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  std::vector<KeptAnswer> answers_;
  SharedBuffer<Contact> contacts_;
  SharedBuffer<RegionDistance> region_distances_;
};

}  // namespace graze
